#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/errors.hpp"
#include "program/options.hpp"

namespace support {

using namespace lorentz;
using Arguments = std::vector<std::string>;

/// A program with an option of every kind.
struct Example {
  double sigma = 0.5;
  double temperature = 500;
  double relaxation = 0.1;
  std::optional<double> gamma;
  std::optional<std::uint32_t> sites = 4;
  Scaled window{{0, 0.5, 0}};
  std::vector<double> times{1, 2};
  std::uint32_t cells = 11;
  std::uint64_t seed = 1;
  bool shifted = false;
  std::string start = "empty";
  std::string output;
  std::uint32_t threads = 4;
  Options options{"example", "An example"};

  Example() {
    options.real("--sigma", sigma, {-1, 1}, "1", "Mass ratio");
    options.real("--temperature", temperature, positive, "temperature", "Temperature");
    options.real("--relaxation-time", relaxation, non_negative, "time", "Time");
    options.real_or_word("--gamma", gamma, non_negative, "N", "1", "Scatterings");
    options.integer_or_word("--sites", sites, {1, 300}, "continuum", "Sites");
    options.scaled("--window", window, positive, "time", "Window");
    options.ascending_list("--times", times, {0, 10}, "time", "Times");
    options.integer("--cells", cells, {1, 100}, "Cells");
    options.integer("--seed", seed, {}, "Seed");
    options.flag("--zero-total-momentum", shifted, "Shift");
    options.choice("--start", start, {"empty", "warm"}, "Start");
    options.text("--output", output, "File", Options::Role::runtime);
    options.integer("--threads", threads, {1, 4096}, "Threads", Options::Role::runtime);
  }

  /// Parses the arguments. Returns the text that is printed instead of a run, as for --help.
  std::optional<std::string> parse(const Arguments& arguments) {
    std::vector<const char*> pointers = {"example"};
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    return options.parse(static_cast<int>(pointers.size()), pointers.data(), "example 1.0");
  }
};

/// Message of the UsageError.
inline std::string refusal(const Arguments& arguments) {
  try {
    Example().parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << testing::PrintToString(arguments) << " was accepted";
  return {};
}

/// The message of the UsageError contains all parts and refers to the help.
inline void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) {
  const std::string message = refusal(arguments);
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << '"' << part << "\" is not in: " << message;
  EXPECT_TRUE(message.ends_with(". Correct it; 'example --help' lists every option.")) << message;
}

}  // namespace support
