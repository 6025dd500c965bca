#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "support/example_options.hpp"

namespace options_test {

using namespace lorentz;
using namespace support;

const Arguments not_numbers = {"",    "nan", "-nan", "inf",  "-inf",   "1e400",   "0x10",
                               "abc", "1,5", "0.5x", " 0.5", "0.5 ",   "1/2",     "+-0.5",
                               "++1", "-+1", "+",    "-",    "0x1p-1", "infinity"};

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
  for (const char* word : {"--sgima", "--sgima=0.5", "-sgima", "--sigm"})
    expect_refused({word, "0.5"}, {" is not an option; the nearest one is --sigma."});
  expect_refused({"--cell", "4"}, {"--cell is not an option; the nearest one is --cells."});
  expect_refused({"-s", "4"}, {"-s is not an option; "});
  expect_refused({"extra"}, {"unexpected argument 'extra'"});
  expect_refused({"--sigma"}, {"--sigma needs a value"});
  expect_refused({"--sigma", "0.5", "--sigma", "0.3"}, {"--sigma is given more than once"});
  expect_refused({"--zero-total-momentum", "--zero-total-momentum"},
                 {"--zero-total-momentum is given more than once"});
  expect_refused({"--start", "hot"}, {"--start", "'hot'", "empty, warm"});
}

TEST(Options, AcceptTheEndsOfTheirRanges) {
  for (const double sigma : {-1.0, 1.0, -0.25, 0.0}) {
    Example example;
    EXPECT_FALSE(example.parse({"--sigma", std::to_string(sigma)}));
    EXPECT_EQ(example.sigma, sigma);
  }
  Example example;
  EXPECT_FALSE(
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

// 0.002877 is so close to the midpoint of two doubles that rounding first to extended precision and then to
// double gives the wrong one. A leading zero does not mean octal.
TEST(Options, ReadNumbersAsTheCompilerDoes) {
  Example example;
  EXPECT_FALSE(
      example.parse({"--sigma", "0.002877", "--temperature", "1e-310", "--cells", "010", "--seed", "09"}));
  EXPECT_EQ(example.sigma, 0.002877);
  EXPECT_EQ(example.temperature, 1e-310);
  EXPECT_EQ(example.cells, 10U);
  EXPECT_EQ(example.seed, 9U);
}

TEST(Options, ReadNumbersOrWords) {
  Example example;
  EXPECT_FALSE(example.parse({"--gamma", "1e-310", "--sites", "continuum"}));
  EXPECT_EQ(example.gamma, 1e-310);
  EXPECT_EQ(example.sites, std::nullopt);
  EXPECT_FALSE(example.parse({"--gamma", "N", "--sites", "300"}));
  EXPECT_EQ(example.gamma, std::nullopt);
  EXPECT_EQ(example.sites, 300U);
  Arguments neither = not_numbers;
  neither.insert(neither.end(), {"-1", "n", "2N", "NN", "continuum"});
  for (const std::string& value : neither)
    expect_refused({"--gamma", value},
                   {"--gamma: '" + value + "' cannot be used: it must be a number at least 0, or N"});
  for (const std::string value : {"0", "301", "2.5", "1e2", "-1", "+-1", "N", "nan", ""})
    expect_refused(
        {"--sites", value},
        {"--sites: '" + value + "' cannot be used: it must be a whole number in [1, 300], or continuum"});
}

TEST(Options, ReadAscendingLists) {
  Example example;
  EXPECT_FALSE(example.parse({"--times", "0,1e-310,+2"}));
  EXPECT_EQ(example.times, (std::vector<double>{0, 1e-310, 2}));
  EXPECT_FALSE(example.parse({"--times", "5"}));
  EXPECT_EQ(example.times, (std::vector<double>{5}));
  for (const std::string value : {"1,2,", ",1,2", "1,,2", ",", "", "1, 2", "2,1", "1,1", "1,nan", "1,inf",
                                  "1,0x2", "1,11", "-1,2", "1,+-2", "1;2", "[1,2]"})
    expect_refused({"--times", value},
                   {"--times: '" + value +
                    "' cannot be used: it must be numbers in [0, 10], ascending, separated by commas"});
}

TEST(Options, ScaleWithTheNumberOfCells) {
  Example example;
  EXPECT_FALSE(example.parse({"--window", "0.05N"}));
  EXPECT_EQ(example.window.at(40), 2);
  EXPECT_FALSE(example.parse({"--window", "10"}));
  EXPECT_EQ(example.window.at(40), 10);
  EXPECT_FALSE(example.parse({"--window", "1e+1+2e-1N+0.5N^2"}));
  EXPECT_EQ(example.window.at(40), 818);
  EXPECT_FALSE(example.parse({"--window", "0.5N^2+10"}));
  EXPECT_EQ(example.window.at(40), 810);
  for (const std::string value : {"N", "1M", "-1N", "1NN", "0N", "0", "", "nanN", "infN", "+-1N", "0x1N",
                                  "1 N", "1+", "1++1N", "1N^3", "1N^", "1+-1N", "0+1N"})
    expect_refused(
        {"--window", value},
        {"--window: '" + value +
         "' cannot be used: it must be a number greater than 0, or a sum of such, each alone or followed by "
         "N or N^2"});
}

TEST(Options, RecordWhatDeterminesTheResultSortedByName) {
  Example example;
  example.parse({"--cells", "7", "--output", "file.h5", "--threads", "2"});
  const std::vector<Parameter> parameters = example.options.parameters();
  const std::vector<Parameter> expected = {{"cells", std::uint64_t{7}},
                                           {"gamma", std::string("N")},
                                           {"relaxation-time", 0.1},
                                           {"seed", std::uint64_t{1}},
                                           {"sigma", 0.5},
                                           {"sites", 4.0},
                                           {"start", std::string("empty")},
                                           {"temperature", 500.0},
                                           {"times", std::string("1,2")},
                                           {"window", std::string("0.5N")},
                                           {"zero-total-momentum", false}};
  ASSERT_EQ(parameters.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(parameters[i].name, expected[i].name);
    EXPECT_TRUE(parameters[i].value == expected[i].value) << expected[i].name;
  }
  example.parse({"--gamma", "3", "--sites", "continuum", "--window", "8"});
  EXPECT_EQ(as_text(example.options.parameters()[1].value), "3");
  EXPECT_EQ(as_text(1.0 / 3), "0.3333333333333333");  // every digit
}

TEST(Options, DescribeThemselves) {
  const auto expect_member = [](const std::string& text) {
    Example example;
    // The described defaults are the declared ones, not these values.
    example.parse({"--sigma", "0.25", "--gamma", "7", "--start", "warm"});
    EXPECT_NE(example.options.describe().find(text), std::string::npos) << example.options.describe();
  };
  expect_member(R"([{"name": "sigma", "type": "number", "description": "Mass ratio", "minimum": -1.0, )"
                R"("maximum": 1.0, "units": "1", "default": 0.5, "affects_results": true},)");
  expect_member(R"("exclusive_minimum": 0.0, "units": "temperature", "default": 500.0)");
  expect_member(R"("minimum": 0.0, "word": "N", "units": "1", "default": "N")");
  expect_member(R"("minimum": 1, "maximum": 300, "word": "continuum", "units": "1", "default": 4.0)");
  expect_member(R"("type": "number or polynomial in N", "description": "Window")");
  expect_member(R"("default": "0.5N")");
  expect_member(R"("default": "1,2")");
  expect_member(R"({"name": "seed", "type": "integer", "description": "Seed", "minimum": 0, "units": "1", )");
  expect_member(R"("type": "flag", "description": "Shift", "default": false, "affects_results": true})");
  expect_member(R"("choices": ["empty", "warm"], "default": "empty")");
  expect_member(R"({"name": "output", "type": "text", "description": "File", "default": "", )"
                R"("affects_results": false})");
}

TEST(Options, HelpListsEveryOptionWithRangeAndDefault) {
  const std::string help = Example().parse({"--help"}).value();
  for (const char* part :
       {"--sigma", "in [-1, 1]; default 0.5", "--temperature", "greater than 0; default 500", "--cells",
        "in [1, 100]; default 11", "--start", "one of empty, warm; default empty", "--seed",
        "--zero-total-momentum", "--output", "--threads", "Temperature [temperature] (a number greater",
        "or N; default N", "default 0.5N", "default 1,2", "or continuum; default 4"})
    EXPECT_NE(help.find(part), std::string::npos) << part;

  EXPECT_EQ(Example().parse({"--version"}), "example 1.0\n");
}

}  // namespace options_test
