#include "program/options.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program/errors.hpp"
#include "support/refusal.hpp"

namespace options_test {

using namespace lorentz;
using Arguments = std::vector<std::string>;

/// A program with an option of every kind.
struct Example {
  double sigma = 0.5, temperature = 500, relaxation = 0.1;
  std::optional<double> gamma{};
  std::optional<std::uint32_t> sites = 4;
  std::vector<double> times{1, 2};
  std::uint32_t cells = 11, threads = 4;
  std::uint64_t seed = 1;
  bool shifted = false;
  std::string start = "empty", output;
  Options options{"example", "An example"};

  Example() {
    options.real(Role::physics, "--sigma", sigma, {-1, 1}, "1", "Mass ratio");
    options.real(Role::physics, "--temperature", temperature, positive, "temperature", "Temperature");
    options.real(Role::physics, "--relaxation-time", relaxation, non_negative, "time", "Time");
    options.real_or_word(Role::physics, "--gamma", gamma, non_negative, "N", "1", "Scatterings");
    options.integer_or_word(Role::physics, "--sites", sites, {1, 300}, "continuum", "Sites");
    options.ascending_list(Role::physics, "--times", times, {0, 10}, "time", "Times");
    options.integer(Role::physics, "--cells", cells, {1, 100}, "Cells");
    options.integer(Role::physics, "--seed", seed, {}, "Seed");
    options.flag(Role::physics, "--zero-total-momentum", shifted, "Shift");
    options.choice(Role::physics, "--start", start, {"empty", "warm"}, "Start");
    options.text(Role::execution, "--output", output, "File");
    options.integer(Role::execution, "--threads", threads, {1, 4096}, "Threads");
  }

  /// Parses the arguments. Returns the text that is printed instead of a run, as for --help.
  std::optional<std::string> parse(const Arguments& arguments) {
    std::vector<const char*> pointers = {"example"};
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    return options.parse(static_cast<int>(pointers.size()), pointers.data(), "example 1.0",
                         [] { return std::string("footer"); });
  }
};

/// The arguments are refused with a message that contains both parts.
void expect_refused(const Arguments& arguments, const std::string& option, const std::string& part = "") {
  const std::string message = support::refusal([&] { Example().parse(arguments); });
  EXPECT_TRUE(message.find(option) != std::string::npos && message.find(part) != std::string::npos)
      << testing::PrintToString(arguments) << ": " << message;
}

void expect_all_refused(const std::string& option, const Arguments& values) {
  for (const std::string& value : values) expect_refused({option, value}, option, "'" + value + "'");
}

TEST(Options, RefuseOtherValues) {
  const Arguments not_numbers = {"", "nan", "inf", "1e400", "0x10", "1,5", "0.5x", " 0.5", "1/2"};
  for (const char* option : {"--sigma", "--gamma", "--cells"}) expect_all_refused(option, not_numbers);
  expect_all_refused("--sigma", {"1.0000000000000003", "-1.0000000000000003"});
  expect_all_refused("--temperature", {"0", "-1", "1.1e30"});
  expect_all_refused("--relaxation-time", {"-1e-300"});
  expect_all_refused("--gamma", {"-1", "n", "2N"});
  expect_all_refused("--sites", {"0", "301", "2.5", "N"});
  expect_all_refused("--cells", {"0", "101", "-1", "1.0", "1e2", "4294967297"});
  expect_all_refused("--seed", {"-1", "9223372036854775808", "18446744073709551616"});
  expect_refused({"--seed", "18446744073709551616"}, "--seed", "from 0 to 9223372036854775807");
  expect_all_refused("--times", {"1,2,", ",1,2", "1, 2", "2,1", "1,1", "1,nan", "1,11", "-1,2"});
  expect_all_refused("--start", {"hot"});
}

// Detected mistake: a name is suggested that is not similar.
TEST(Options, RefuseUnknownAndRepeatedNamesWithTheMostSimilarOne) {
  expect_refused({"--sgima", "0.5"}, "--sgima", "--sigma");
  expect_refused({"--treads=2"}, "--treads", "--threads");
  const std::string message = support::refusal([] { Example().parse({"--wxyz"}); });
  const Example example;
  for (const Option& option : example.options.all())
    EXPECT_EQ(message.find(option.name), std::string::npos) << message;
  for (const char* word : {"--sigm", "-s", "extra"}) expect_refused({word, "0.5"}, word);
  expect_refused({"--sigma"}, "--sigma");
  expect_refused({"--sigma", "0.5", "--sigma", "0.3"}, "--sigma", "more than once");
}

// An attribute of the result has at most 64 kB. Detected mistake: numbers are counted as they are given.
TEST(Options, RefuseListsThatAResultCannotState) {
  std::string list = "0";  // 1e-9 is stated as 1e-09
  for (int i = 1; i < 7000; ++i) list += ',' + std::to_string(i) + "e-9";
  EXPECT_LT(list.size(), 60'000U);
  expect_refused({"--times", list}, "60000");
}

TEST(Options, AcceptTheEndsOfTheirRanges) {
  Example example;
  EXPECT_FALSE(
      example.parse({"--sigma=-1", "--temperature", "1e-30", "--relaxation-time", "0", "--cells", "100",
                     "--seed", "9223372036854775807", "--start", "warm", "--zero-total-momentum", "--gamma",
                     "1e30", "--sites", "300", "--times", "0,1e-310,+2,10"}));
  EXPECT_EQ(example.sigma, -1);
  EXPECT_EQ(example.temperature, 1e-30);
  EXPECT_EQ(example.relaxation, 0);
  EXPECT_EQ(example.cells, 100U);
  EXPECT_EQ(example.seed, std::uint64_t{9223372036854775807});
  EXPECT_EQ(example.start, "warm");
  EXPECT_TRUE(example.shifted);
  EXPECT_EQ(example.gamma, 1e30);
  EXPECT_EQ(example.sites, 300U);
  EXPECT_EQ(example.times, (std::vector<double>{0, 1e-310, 2, 10}));
  EXPECT_TRUE(example.options.given("--cells"));
  EXPECT_FALSE(example.options.given("--threads"));
  Example words;
  EXPECT_FALSE(words.parse({"--sites", "continuum", "--gamma", "N"}));
  EXPECT_EQ(words.sites, std::nullopt);
  EXPECT_EQ(words.gamma, std::nullopt);
}

// Detected mistake: an option that a rule requires is recorded with other rules, too.
TEST(Options, AreRecordedWithTheirRole) {
  Example example;
  std::optional<double> of_flip, of_flip_twice;
  example.options.of_rule("flip", "--flip-twice-angle", of_flip, {0, 1}, "1", "Angle");
  example.options.of_rule("flip-twice", "--flip-twice-rate", of_flip_twice, {0, 1}, "1", "Rate");
  example.parse({"--flip-twice-rate", "0.3"});
  std::vector<std::string> rules;
  for (const Parameter& each : example.options.parameters()) {
    EXPECT_EQ(each.role, "physics") << each.name;
    if (!each.rule.empty()) rules.push_back(each.name + " of " + each.rule);
  }
  EXPECT_EQ(rules, Arguments{"flip_twice_rate of flip-twice"});
}

TEST(Options, KeepTheirWordsAsGiven) {
  Example example;
  example.parse({"--threads", "2", "--sigma=+.50", "--zero-total-momentum", "--output=a", "--cells", "007"});
  EXPECT_EQ(example.options.option_words(), "--sigma=+.50 --zero-total-momentum --cells 007");
}

}  // namespace options_test
