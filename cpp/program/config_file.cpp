#include "program/config_file.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace lorentz {
namespace {
/// What toml++ asserts is wrong of some files, as of "[ = 1". They are refused, and do not end the process.
constexpr void require_rules_of_toml(bool kept) {
  if (!kept) throw std::invalid_argument("the rules of TOML are broken");
}
}  // namespace
}  // namespace lorentz

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): toml++ asks for a macro
#define TOML_ASSERT(expression) lorentz::require_rules_of_toml(static_cast<bool>(expression))
#include <toml++/toml.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "program/errors.hpp"

namespace lorentz {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw UsageError(
      fmt::format("--config: '{}' cannot be read: {}. Name a TOML file that can be.", path, why));
}

std::string content_of(const std::string& path) try {
  std::error_code missing;
  const auto status = std::filesystem::status(path, missing);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuse(path, "it is not a regular file");
  std::ifstream file;
  file.exceptions(std::ios::failbit);
  file.open(path);
  return {std::istreambuf_iterator<char>(file), {}};
} catch (const std::ios::failure&) {
  refuse(path, std::strerror(errno));
}

ConfigEntry entry(const toml::node& node) {
  using Form = ConfigEntry::Form;
  if (node.is_table()) return {.form = Form::scalar, .literal = "{...}", .text = "{...}"};
  if (node.is_string()) {
    const std::string& text = node.ref<std::string>();
    return {.form = Form::string, .literal = '"' + text + '"', .text = text};
  }
  if (node.is_array()) {
    std::vector<std::string> items;
    for (const toml::node& item : *node.as_array()) items.push_back(entry(item).literal);
    const std::string text = fmt::format("{}", fmt::join(items, ","));
    return {.form = Form::array, .literal = '[' + text + ']', .text = text};
  }
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return {.form = Form::scalar, .literal = text.str(), .text = text.str()};
}

}  // namespace

std::vector<ConfigEntry> read_config_file(const std::string& path) try {
  std::vector<ConfigEntry> entries;
  for (const auto& [key, node] : toml::parse(content_of(path))) {
    entries.push_back(entry(node));
    entries.back().key = key.str();
    entries.back().place = fmt::format("{}, line {}", path, key.source().begin.line);
  }
  return entries;
} catch (const std::invalid_argument&) {
  refuse(path, "it breaks the rules of TOML");
} catch (const toml::parse_error& error) {
  const toml::source_position where = error.source().begin;
  throw UsageError(fmt::format("{}, line {}, column {}: {}. Correct the file.", path, where.line,
                               where.column, error.description()));
}

}  // namespace lorentz
