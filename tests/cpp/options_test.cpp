#include "program/options.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "program/errors.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace lorentz;
using Arguments = std::vector<std::string>;

/// A program with an option of every kind.
struct Example {
  double sigma = 0.5;
  double temperature = 500;
  double relaxation = 0.1;
  std::uint32_t cells = 11;
  std::uint64_t seed = 1;
  bool shifted = false;
  std::string start = "empty";
  std::string output;
  std::uint32_t threads = 4;
  Options options{"example", "An example"};

  Example() {
    options.real("--sigma", sigma, {-1, 1}, "Mass ratio");
    options.real("--temperature", temperature, positive, "Temperature");
    options.real("--relaxation-time", relaxation, non_negative, "Time");
    options.integer("--cells", cells, {1, 100}, "Cells");
    options.integer("--seed", seed, {}, "Seed");
    options.flag("--zero-total-momentum", shifted, "Shift");
    options.choice("--start", start, {"empty", "warm"}, "Start");
    options.text("--output", output, "File", Options::Role::conduct);
    options.integer("--threads", threads, {1, 4096}, "Threads", Options::Role::conduct);
  }

  bool parse(const Arguments& arguments) {
    std::vector<const char*> pointers = {"example"};
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    return options.parse(static_cast<int>(pointers.size()), pointers.data(), "example 1.0");
  }
};

/// The message of the refusal contains every one of the parts.
void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) {
  Example example;
  try {
    example.parse(arguments);
    ADD_FAILURE() << testing::PrintToString(arguments) << " was accepted";
  } catch (const UsageError& error) {
    const std::string message = error.what();
    for (const std::string& part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << '"' << part << "\" is not in: " << message;
    EXPECT_NE(message.find("--help"), std::string::npos) << message;
  }
}

const Arguments not_numbers = {"",    "nan", "-nan", "inf",  "-inf", "1e400", "0x10",
                               "abc", "1,5", "0.5x", " 0.5", "0.5 ", "1/2"};

TEST(Options, RefuseBadNumbersWithNameValueAndRange) {
  Arguments outside = not_numbers;
  outside.insert(outside.end(), {"2", "-2", "1.0000000000000003", "-1.0000000000000003"});
  for (const std::string& value : outside)
    expect_refused({"--sigma", value}, {"--sigma", "'" + value + "'", "number in [-1, 1]"});

  Arguments not_positive = not_numbers;
  not_positive.insert(not_positive.end(), {"0", "-0", "-1", "-5e-324"});
  for (const std::string& value : not_positive)
    expect_refused({"--temperature", value}, {"--temperature", "'" + value + "'", "greater than 0"});

  for (const std::string value : {"-1e-300", "-5", "nan"})
    expect_refused({"--relaxation-time", value}, {"--relaxation-time", "'" + value + "'", "at least 0"});
}

TEST(Options, RefuseBadWholeNumbersWithNameValueAndRange) {
  Arguments bad = not_numbers;
  bad.insert(bad.end(), {"0", "101", "-1", "-0", "1.0", "1e2", "99999999999999999999999", "4294967297"});
  for (const std::string& value : bad)
    expect_refused({"--cells", value}, {"--cells", "'" + value + "'", "whole number in [1, 100]"});
  for (const std::string value : {"-1", "18446744073709551616"})
    expect_refused({"--seed", value}, {"--seed", "'" + value + "'", "whole number"});
}

TEST(Options, RefuseWhatIsNotThere) {
  expect_refused({"--sgima", "0.5"}, {"--sgima"});
  expect_refused({"extra"}, {"extra"});
  expect_refused({"--sigma"}, {"--sigma"});
  expect_refused({"--sigma", "0.5", "--sigma", "0.3"}, {"--sigma"});
  expect_refused({"--start", "hot"}, {"--start", "'hot'", "empty, warm"});
}

TEST(Options, AcceptTheEndsOfTheirRanges) {
  for (const double sigma : {-1.0, 1.0, -0.25, 0.0}) {
    Example example;
    EXPECT_TRUE(example.parse({"--sigma", std::to_string(sigma)}));
    EXPECT_EQ(example.sigma, sigma);
  }
  Example example;
  EXPECT_TRUE(
      example.parse({"--sigma=+.5", "--temperature", "1e-3", "--relaxation-time", "0", "--cells", "100",
                     "--seed", "18446744073709551615", "--start", "warm", "--zero-total-momentum"}));
  EXPECT_EQ(example.sigma, 0.5);
  EXPECT_EQ(example.temperature, 0.001);
  EXPECT_EQ(example.relaxation, 0);
  EXPECT_EQ(example.cells, 100U);
  EXPECT_EQ(example.seed, ~std::uint64_t{0});
  EXPECT_EQ(example.start, "warm");
  EXPECT_TRUE(example.shifted);
  EXPECT_TRUE(example.options.given("--cells"));
  EXPECT_FALSE(example.options.given("--threads"));
}

// 0.002877 lies so close to the middle of two doubles that rounding it twice, by way of extended precision,
// picks the wrong one. A leading zero does not make a number octal.
TEST(Options, ReadNumbersAsTheCompilerDoes) {
  Example example;
  EXPECT_TRUE(
      example.parse({"--sigma", "0.002877", "--temperature", "1e-310", "--cells", "010", "--seed", "09"}));
  EXPECT_EQ(example.sigma, 0.002877);
  EXPECT_EQ(example.temperature, 1e-310);
  EXPECT_EQ(example.cells, 10U);
  EXPECT_EQ(example.seed, 9U);
}

TEST(Options, ReadTheSmallestNumbersInWordsAndLists) {
  Options options("example", "An example");
  double gamma = 1;
  std::vector<double> times;
  options.real_or_word("--gamma", gamma, positive, "N", 0, "Gamma");
  options.ascending_list("--times", times, non_negative, "Times");
  const std::vector<const char*> arguments = {"example", "--gamma", "1e-310", "--times", "0,1e-310,2"};
  EXPECT_TRUE(options.parse(static_cast<int>(arguments.size()), arguments.data(), ""));
  EXPECT_EQ(gamma, 1e-310);
  EXPECT_EQ(times, (std::vector<double>{0, 1e-310, 2}));
}

TEST(Options, ScaleWithTheNumberOfCells) {
  Options options("example", "An example");
  Scaled relaxation{10}, observation{10};
  options.scaled("--relaxation-time", relaxation, non_negative, "Relaxation");
  options.scaled("--observation-time", observation, positive, "Observation");
  const std::vector<const char*> arguments = {"example", "--relaxation-time", "0.05N"};
  EXPECT_TRUE(options.parse(static_cast<int>(arguments.size()), arguments.data(), ""));
  EXPECT_EQ(relaxation.at(40), 2);
  EXPECT_EQ(observation.at(40), 10);
  EXPECT_EQ(as_text(options.parameters()), "observation-time = 10\nrelaxation-time = 0.05N\n");
  for (const char* wrong : {"N", "1M", "-1N", "1NN", "0N"}) {
    const std::vector<const char*> bad = {"example", "--observation-time", wrong};
    EXPECT_THROW(options.parse(static_cast<int>(bad.size()), bad.data(), ""), UsageError) << wrong;
  }
}

TEST(Options, RecordWhatDeterminesTheResultSortedByName) {
  Example example;
  example.parse({"--cells", "7", "--output", "file.h5", "--threads", "2"});
  const std::vector<Parameter> parameters = example.options.parameters();
  const std::vector<Parameter> expected = {{"cells", std::uint64_t{7}},     {"relaxation-time", 0.1},
                                           {"seed", std::uint64_t{1}},      {"sigma", 0.5},
                                           {"start", std::string("empty")}, {"temperature", 500.0},
                                           {"zero-total-momentum", false}};
  ASSERT_EQ(parameters.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(parameters[i].name, expected[i].name);
    EXPECT_TRUE(parameters[i].value == expected[i].value) << expected[i].name;
  }
  EXPECT_EQ(as_text(parameters),
            "cells = 7\nrelaxation-time = 0.1\nseed = 1\nsigma = 0.5\nstart = empty\ntemperature = 500\n"
            "zero-total-momentum = false\n");
  EXPECT_EQ(as_text({{"third", 1.0 / 3}}), "third = 0.3333333333333333\n");  // every digit
}

TEST(Options, ReadAConfigurationFile) {
  const support::TemporaryFolder folder;
  const std::string path = folder / "run.toml";
  support::write_file(
      path, "# a comment\nsigma = -0.25\ncells = 7\nstart = \"warm\"\nzero-total-momentum = true\n");
  Example example;
  EXPECT_TRUE(example.parse({"--config", path, "--cells", "8"}));
  EXPECT_EQ(example.sigma, -0.25);
  EXPECT_EQ(example.cells, 8U);  // the command line has the last word
  EXPECT_EQ(example.start, "warm");
  EXPECT_TRUE(example.shifted);
  EXPECT_EQ(example.temperature, 500);
}

TEST(Options, RefuseABadConfigurationFile) {
  const support::TemporaryFolder folder;
  const std::string path = folder / "run.toml";
  const auto expect_file_refused = [&](const std::string& content, const std::vector<std::string>& parts) {
    support::write_file(path, content);
    expect_refused({"--config", path}, parts);
  };
  expect_file_refused("sigma = 0.5\nsgima = 0.5\n", {"sgima"});
  expect_file_refused("[section]\nsigma = 0.5\n", {"section"});
  expect_file_refused("sigma = 2\n", {"--sigma", "'2'", "[-1, 1]"});
  expect_file_refused("cells = 0.5\n", {"--cells", "'0.5'", "[1, 100]"});
  expect_file_refused("start = \"hot\"\n", {"--start", "'hot'", "empty, warm"});
  expect_refused({"--config", folder / "absent.toml"}, {"absent.toml"});
}

TEST(Options, HelpListsEveryOptionWithRangeAndDefault) {
  testing::internal::CaptureStdout();
  EXPECT_FALSE(Example().parse({"--help"}));
  const std::string help = testing::internal::GetCapturedStdout();
  for (const char* part :
       {"--sigma", "in [-1, 1]; default 0.5", "--temperature", "greater than 0; default 500", "--cells",
        "in [1, 100]; default 11", "--start", "one of empty, warm; default empty", "--seed",
        "--zero-total-momentum", "--output", "--threads", "--config"})
    EXPECT_NE(help.find(part), std::string::npos) << part;

  testing::internal::CaptureStdout();
  EXPECT_FALSE(Example().parse({"--version"}));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "example 1.0\n");
}

}  // namespace
