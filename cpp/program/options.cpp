#include "program/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include "program/errors.hpp"

namespace lorentz {
namespace {

/// Reads a decimal number, rounded to nearest. libc++ 16 to 19 lack std::from_chars of a double; std::strtod
/// also reads spaces, nan, infinity and hexadecimal numbers.
bool read(const std::string& text, const Option& option, double& value) {
  if (text.find_first_not_of("0123456789.+-eE") != std::string::npos) return false;
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value) && value >= option.range.low &&
         value <= option.range.high;
}

template <std::unsigned_integral Whole>
  requires(!std::same_as<Whole, bool>)
bool read(const std::string& text, const Option& option, Whole& value) {
  const char* const end = text.data() + text.size();
  std::int64_t whole = 0;
  const auto [stop, error] = std::from_chars(text.data(), end, whole);
  value = static_cast<Whole>(whole);
  const auto number = static_cast<double>(whole);
  return error == std::errc{} && stop == end && number >= option.range.low && number <= option.range.high;
}

template <class Number>
bool read(const std::string& text, const Option& option, std::optional<Number>& value) {
  if (option.words.empty() || text != option.words.front()) return read(text, option, value.emplace());
  value.reset();
  return true;
}

bool read(const std::string& text, const Option& option, std::vector<double>& values) {
  values.clear();
  for (std::size_t begin = 0, end = 0; end != text.size(); begin = end + 1) {
    end = std::min(text.find(',', begin), text.size());
    if (!read(text.substr(begin, end - begin), option, values.emplace_back())) return false;
  }
  return !values.empty() && std::ranges::adjacent_find(values, std::greater_equal()) == values.end();
}

bool read(const std::string& text, const Option&, bool& value) {
  value = text == "true";
  return value || text == "false";
}

bool read(const std::string& text, const Option& option, std::string& value) {
  value = text;
  return option.words.empty() || std::ranges::find(option.words, text) != option.words.end();
}

AttributeValue recorded(const Option&, double value) { return value; }
template <std::unsigned_integral Whole>
AttributeValue recorded(const Option&, Whole value) {
  return static_cast<std::int64_t>(value);
}
template <class Number>
AttributeValue recorded(const Option& option, const std::optional<Number>& value) {
  if (value) return recorded(option, *value);
  return option.words.empty() ? "" : option.words.front();
}
AttributeValue recorded(const Option&, const std::vector<double>& values) {
  return fmt::format("{}", fmt::join(values, ","));
}
AttributeValue recorded(const Option&, bool value) { return value; }
AttributeValue recorded(const Option&, const std::string& value) { return value; }

/// The least number of characters to insert, delete or replace in one word to make the other.
std::size_t edit_distance(const std::string& word, const std::string& other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (const char character : word) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 0; k < other.size(); ++k) {
      const std::size_t replaced = diagonal + (character == other[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, diagonal + 1, row[k] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string as_text(const AttributeValue& value) {
  return std::visit([](const auto& content) { return fmt::format("{}", content); }, value);
}

bool Option::read(const std::string& text) const {
  return std::visit([&](auto* value) { return lorentz::read(text, *this, *value); }, variable);
}

AttributeValue Option::value() const {
  return std::visit([&](const auto* content) { return recorded(*this, *content); }, variable);
}

std::string Option::end(double limit) const {
  if (!is_whole()) return fmt::format("{}", limit);
  constexpr auto largest = std::numeric_limits<std::int64_t>::max();
  return fmt::format("{}", limit < static_cast<double>(largest) ? static_cast<std::int64_t>(limit) : largest);
}

std::string Option::allowed() const {
  if (is_flag()) return "true or false";
  if (is_text()) return words.empty() ? "text" : fmt::format("one of {}", fmt::join(words, ", "));
  const std::string numbers = fmt::format("from {} to {}", end(range.low), end(range.high));
  if (is_list()) return fmt::format("numbers {}, ascending, separated by commas", numbers);
  const std::string word = words.empty() ? "" : ", or " + words.front();
  return fmt::format("a {}number {}{}", is_whole() ? "whole " : "", numbers, word);
}

std::string Option::role_name() const {
  constexpr std::array names{"physics", "effort", "output", "execution"};
  return names.at(static_cast<std::size_t>(role));
}

Options::Options(std::string program, std::string description)
    : program_(std::move(program)), description_(std::move(description)) {}

void Options::add(Option option) {
  option.default_value = option.value();
  options_.push_back(std::move(option));
}

const Option& Options::named(const std::string& name) const {
  return *std::ranges::find(options_, name, &Option::name);
}

std::string Options::help() const {
  const auto line = [](const std::string& name, const std::string& text) {
    return fmt::format("  {:<33} {}\n", name, text);
  };
  std::string text = fmt::format("{}\nUsage: {} [OPTIONS]\n\nOptions:\n", description_, program_) +
                     line("-h, --help", "Print options and quantities, then exit") +
                     line("--version", "Print version and hash of the sources, then exit");
  for (const Option& option : options_) {
    std::string about = option.help;
    if (!option.units.empty() && option.units != "1") about += fmt::format(" [{}]", option.units);
    std::string value = "default " + as_text(option.default_value);
    if (!option.has_default()) value = option.required ? "required" : "required by --rule " + option.rule;
    if (!option.is_flag() && !(option.is_text() && option.words.empty()))
      about += fmt::format(" ({}; {})", option.allowed(), value);
    text += line(option.name, about);
  }
  return text + '\n';
}

void Options::refuse(const std::string& why) const {
  throw UsageError(fmt::format("{}. Correct it; '{} --help' lists every option.", why, program_));
}

void Options::refuse_unknown(const std::string& word) const {
  const std::string name = word.substr(0, word.find('='));
  const auto distance = [&](const Option& option) { return edit_distance(name, option.name); };
  const Option& nearest = *std::ranges::min_element(options_, {}, distance);
  if (3 * distance(nearest) > name.size()) refuse(word + " is not an option");
  throw UsageError(fmt::format("{} is not an option; did you mean {}?", name, nearest.name));
}

void Options::read(std::span<const char* const> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = words[i], name = word.substr(0, word.find('='));
    const auto option = std::ranges::find(options_, name, &Option::name);
    if (option == options_.end()) refuse_unknown(word);
    if (std::exchange(option->given, true)) refuse(name + " is given more than once");
    if (option->role != Role::execution) option_words_ += (option_words_.empty() ? "" : " ") + word;
    std::string value = name == word ? "true" : word.substr(name.size() + 1);
    if (name == word && !option->is_flag()) {
      if (i + 1 == words.size() || std::string_view(words[i + 1]).starts_with("--"))
        refuse(name + " needs a value");
      value = words[++i];
      if (option->role != Role::execution) option_words_ += ' ' + value;
    }
    if (!option->read(value))
      refuse(fmt::format("{}: '{}' cannot be used: it must be {}", name, value, option->allowed()));
  }
}

std::optional<std::string> Options::parse(int argc, const char* const* argv, const std::string& version,
                                          const std::function<std::string()>& footer) {
  const std::span words(argv + 1, argv + argc);
  const auto has = [&](std::string_view word) { return std::ranges::find(words, word) != words.end(); };
  if (has("--help") || has("-h")) return help() + footer();
  if (has("--version")) return version + '\n';
  read(words);
  constexpr std::size_t most = 60'000;  // an attribute of an HDF5 file has at most 64 kB
  std::size_t of_parameters = 0;
  for (const Parameter& parameter : parameters())
    of_parameters += parameter.name.size() + as_text(parameter.value).size();
  if (const std::size_t length = std::max(of_parameters, option_words_.size()); length > most)
    throw UsageError(fmt::format(
        "the options take {} characters, more than the {} that a result can state. Give shorter lists.",
        length, most));
  return {};
}

void Options::omit(const std::string& name) {
  std::ranges::find(options_, name, &Option::name)->role = Role::execution;
}

std::vector<Parameter> Options::parameters() const {
  std::vector<Parameter> result;
  for (const Option& option : options_)
    if (option.role != Role::execution && (option.rule.empty() || option.given))
      result.push_back(
          {option.name.substr(2), option.value(), option.units, option.role_name(), option.rule});
  for (Parameter& parameter : result) std::ranges::replace(parameter.name, '-', '_');
  std::ranges::sort(result, {}, &Parameter::name);
  return result;
}

}  // namespace lorentz
