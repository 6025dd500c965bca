#include "program/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
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
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const auto number = static_cast<double>(value);
  return error == std::errc{} && stop == end && number >= option.range.low && number <= option.range.high;
}

template <class Number>
bool read(const std::string& text, const Option& option, std::optional<Number>& value) {
  if (text != option.words.front()) return read(text, option, value.emplace());
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

/// A number is recorded as floating point where it may be a word, also if it is whole.
template <class Number>
AttributeValue recorded(const Option& option, const std::optional<Number>& value) {
  return value ? AttributeValue(static_cast<double>(*value)) : AttributeValue(option.words.front());
}
AttributeValue recorded(const Option&, std::uint32_t value) { return std::uint64_t{value}; }
AttributeValue recorded(const Option&, const std::vector<double>& values) {
  return fmt::format("{}", fmt::join(values, ","));
}
AttributeValue recorded(const Option&, const auto& value) { return value; }

/// The least number of characters to insert, delete or replace in one word to make the other.
std::size_t edit_distance(const std::string& one, const std::string& other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (const char character : one) {
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
  return std::visit([](const auto& each) { return fmt::format("{}", each); }, value);
}

bool Option::read(const std::string& text) const {
  return std::visit([&](auto* each) { return lorentz::read(text, *this, *each); }, variable);
}

AttributeValue Option::value() const {
  return std::visit([&](const auto* each) { return recorded(*this, *each); }, variable);
}

std::string Option::allowed() const {
  if (is_flag()) return "true or false";
  if (std::holds_alternative<std::string*>(variable))
    return words.empty() ? "text" : fmt::format("one of {}", fmt::join(words, ", "));
  const std::string numbers = std::isfinite(range.high) ? fmt::format("from {} to {}", range.low, range.high)
                                                        : fmt::format("at least {}", range.low);
  if (std::holds_alternative<std::vector<double>*>(variable))
    return fmt::format("numbers {}, ascending, separated by commas", numbers);
  const bool real =
      std::holds_alternative<double*>(variable) || std::holds_alternative<std::optional<double>*>(variable);
  const std::string word = words.empty() ? "" : ", or " + words.front();
  return fmt::format("a {}number {}{}", real ? "" : "whole ", numbers, word);
}

Options::Options(std::string program, const std::string& description)
    : program_(std::move(program)), app_(std::make_unique<CLI::App>(description, program_)) {
  app_->set_version_flag("--version", std::string{}, "Print version and hash of the sources, then exit");
  app_->get_formatter()->column_width(36);
}

Options::~Options() = default;

void Options::add(Option option) {
  option.default_value = option.value();
  const std::string units = option.units.empty() || option.units == "1" ? "" : " [" + option.units + ']',
                    value = as_text(option.default_value), text = option.help + units,
                    initial = option.required ? "required" : "default " + value;
  if (option.is_flag())
    app_->add_flag(option.name, text);
  else
    app_->add_option(option.name, CLI::callback_t{},
                     value.empty() ? text : fmt::format("{} ({}; {})", text, option.allowed(), initial))
        ->type_name("")
        ->take_all();
  options_.push_back(std::move(option));
}

bool Options::given(const std::string& name) const { return app_->count(name) > 0; }

std::optional<std::string> Options::parse(int argc, const char* const* argv, const std::string& version,
                                          const std::function<std::string()>& footer) {
  app_->footer(footer);
  const auto refuse = [this](const std::string& why) {
    throw UsageError(fmt::format("{}. Correct it; '{} --help' lists every option.", why, program_));
  };
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app_->help();
  } catch (const CLI::CallForVersion&) {
    return version + '\n';
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string what = error.what();
    refuse(what.substr(0, what.find(':')) + " needs a value");
  } catch (const CLI::ExtrasError&) {
    const std::string word = app_->remaining().front(), name = word.substr(0, word.find('='));
    const auto distance = [&](const Option& option) { return edit_distance(name, option.name); };
    const Option& nearest = *std::ranges::min_element(options_, {}, distance);
    if (3 * distance(nearest) > name.size()) refuse(word + " is not an option");
    throw UsageError(fmt::format("{} is not an option; did you mean {}?", name, nearest.name));
  } catch (const CLI::ParseError& error) {
    refuse(error.what());
  }
  for (const Option& option : options_) {
    const std::vector<std::string>& values = app_->get_option(option.name)->results();
    if (values.size() > 1) refuse(option.name + " is given more than once");
    if (!values.empty() && !option.read(values.front()))
      refuse(fmt::format("{}: '{}' cannot be used: it must be {}", option.name, values.front(),
                         option.allowed()));
  }
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], name = word.substr(0, word.find('='));
    const auto option = std::ranges::find(options_, name, &Option::name);
    if (option == options_.end() || option->role != Role::result) continue;
    option_words_ += (option_words_.empty() ? "" : " ") + word;
    if (name == word && !option->is_flag()) option_words_ += ' ' + std::string(argv[++i]);
  }
  constexpr std::size_t most = 60'000;  // an attribute of an HDF5 file has at most 64 kB
  std::size_t of_parameters = 0;
  for (const Parameter& each : parameters()) of_parameters += each.name.size() + as_text(each.value).size();
  if (const std::size_t length = std::max(of_parameters, option_words_.size()); length > most)
    throw UsageError(fmt::format(
        "the options take {} characters, more than the {} that a result can state. Give shorter lists.",
        length, most));
  return {};
}

void Options::omit(const std::string& name) {
  std::ranges::find(options_, name, &Option::name)->role = Role::runtime;
}

std::vector<Parameter> Options::parameters() const {
  std::vector<Parameter> result;
  for (const Option& option : options_)
    if (option.role == Role::result) result.push_back({option.name.substr(2), option.value(), option.units});
  for (Parameter& each : result) std::ranges::replace(each.name, '-', '_');
  std::ranges::sort(result, {}, &Parameter::name);
  return result;
}

}  // namespace lorentz
