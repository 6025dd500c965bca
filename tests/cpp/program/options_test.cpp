#include "program/options.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <optional>
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
    options.scaled("--window", window, positive, 'N', "time", "Window");
    options.ascending_list("--times", times, {0, 10}, "time", "Times");
    options.integer("--cells", cells, {1, 100}, "Cells");
    options.integer("--seed", seed, {}, "Seed");
    options.flag("--zero-total-momentum", shifted, "Shift");
    options.choice("--start", start, {"empty", "warm"}, "Start");
    options.text("--output", output, "File", Options::Role::runtime);
    options.integer("--threads", threads, {1, 4096}, "Threads", Options::Role::runtime);
  }

  bool parse(const Arguments& arguments) {
    std::vector<const char*> pointers = {"example"};
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    return options.parse(static_cast<int>(pointers.size()), pointers.data(), "example 1.0");
  }
};

/// Message of the UsageError.
std::string refusal(const Arguments& arguments) {
  try {
    Example().parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << testing::PrintToString(arguments) << " was accepted";
  return {};
}

/// The message of the UsageError contains all parts and refers to the help.
void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) {
  const std::string message = refusal(arguments);
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << '"' << part << "\" is not in: " << message;
  EXPECT_TRUE(message.ends_with(". Correct it; 'example --help' lists every option.")) << message;
}

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
    expect_refused({word, "0.5"}, {"no option has the name ", "; the nearest one is --sigma."});
  expect_refused({"--cell", "4"}, {"--cell; the nearest one is --cells."});
  expect_refused({"-s", "4"}, {"no option has the name -s; "});
  expect_refused({"extra"}, {"'extra' is no option and belongs to none"});
  expect_refused({"--sigma"}, {"--sigma needs a value"});
  for (const Arguments& empty : {Arguments{"--sigma="}, {"--sigma=", "0.5"}, {"--cells=", "--sigma", "0.5"}})
    expect_refused(empty, {"= is followed by nothing"});
  expect_refused({"--sigma", "0.5", "--sigma", "0.3"}, {"--sigma is given more than once"});
  expect_refused({"--zero-total-momentum", "--zero-total-momentum"},
                 {"--zero-total-momentum is given more than once"});
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

// 0.002877 is so close to the midpoint of two doubles that double rounding, through extended precision, gives
// the wrong one. A leading zero does not mean octal.
TEST(Options, ReadNumbersAsTheCompilerDoes) {
  Example example;
  EXPECT_TRUE(
      example.parse({"--sigma", "0.002877", "--temperature", "1e-310", "--cells", "010", "--seed", "09"}));
  EXPECT_EQ(example.sigma, 0.002877);
  EXPECT_EQ(example.temperature, 1e-310);
  EXPECT_EQ(example.cells, 10U);
  EXPECT_EQ(example.seed, 9U);
}

TEST(Options, ReadNumbersOrWords) {
  Example example;
  EXPECT_TRUE(example.parse({"--gamma", "1e-310", "--sites", "continuum"}));
  EXPECT_EQ(example.gamma, 1e-310);
  EXPECT_EQ(example.sites, std::nullopt);
  EXPECT_TRUE(example.parse({"--gamma", "N", "--sites", "300"}));
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
  EXPECT_TRUE(example.parse({"--times", "0,1e-310,+2"}));
  EXPECT_EQ(example.times, (std::vector<double>{0, 1e-310, 2}));
  EXPECT_TRUE(example.parse({"--times", "5"}));
  EXPECT_EQ(example.times, (std::vector<double>{5}));
  for (const std::string value : {"1,2,", ",1,2", "1,,2", ",", "", "1, 2", "2,1", "1,1", "1,nan", "1,inf",
                                  "1,0x2", "1,11", "-1,2", "1,+-2", "1;2", "[1,2]"})
    expect_refused({"--times", value},
                   {"--times: '" + value +
                    "' cannot be used: it must be numbers in [0, 10], ascending, separated by commas"});
}

TEST(Options, ScaleWithTheNumberOfCells) {
  Example example;
  EXPECT_TRUE(example.parse({"--window", "0.05N"}));
  EXPECT_EQ(example.window.at(40), 2);
  EXPECT_TRUE(example.parse({"--window", "10"}));
  EXPECT_EQ(example.window.at(40), 10);
  EXPECT_TRUE(example.parse({"--window", "1e+1+2e-1N+0.5N^2"}));
  EXPECT_EQ(example.window.at(40), 818);
  EXPECT_TRUE(example.parse({"--window", "0.5N^2+10"}));
  EXPECT_EQ(example.window.at(40), 810);
  for (const std::string value :
       {"N",    "1M",  "-1N", "1NN",   "0N",  "0",     "",     "nanN", "infN",  "+-1N",
        "0x1N", "1 N", "1+",  "1++1N", "1+2", "1N+2N", "1N^3", "1N^",  "1+-1N", "0+1N"})
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
  EXPECT_EQ(as_text(parameters),
            "cells = 7\ngamma = N\nrelaxation-time = 0.1\nseed = 1\nsigma = 0.5\nsites = 4\nstart = empty\n"
            "temperature = 500\ntimes = 1,2\nwindow = 0.5N\nzero-total-momentum = false\n");
  example.parse({"--gamma", "3", "--sites", "continuum", "--window", "8"});
  EXPECT_EQ(as_text(example.options.parameters()).find("gamma = 3\n"), 10U);
  EXPECT_EQ(as_text({{"third", 1.0 / 3}}), "third = 0.3333333333333333\n");  // every digit
}

TEST(Options, DescribeThemselves) {
  const nlohmann::json expected = nlohmann::json::parse(R"([
    {"name": "sigma", "type": "number", "minimum": -1, "maximum": 1, "default": 0.5, "units": "1",
     "description": "Mass ratio", "affects_results": true},
    {"name": "temperature", "type": "number", "exclusive_minimum": 0, "default": 500, "units": "temperature",
     "description": "Temperature", "affects_results": true},
    {"name": "relaxation-time", "type": "number", "minimum": 0, "default": 0.1, "units": "time",
     "description": "Time", "affects_results": true},
    {"name": "gamma", "type": "number or word", "minimum": 0, "word": "N", "default": "N", "units": "1",
     "description": "Scatterings", "affects_results": true},
    {"name": "sites", "type": "integer or word", "minimum": 1, "maximum": 300, "word": "continuum", "default": 4,
     "units": "1", "description": "Sites", "affects_results": true},
    {"name": "window", "type": "number or polynomial in N", "exclusive_minimum": 0, "default": "0.5N",
     "units": "time", "description": "Window", "affects_results": true},
    {"name": "times", "type": "numbers", "minimum": 0, "maximum": 10, "default": "1,2", "units": "time",
     "description": "Times", "affects_results": true},
    {"name": "cells", "type": "integer", "minimum": 1, "maximum": 100, "default": 11, "units": "1",
     "description": "Cells", "affects_results": true},
    {"name": "seed", "type": "integer", "minimum": 0, "default": 1, "units": "1", "description": "Seed",
     "affects_results": true},
    {"name": "zero-total-momentum", "type": "flag", "default": false, "description": "Shift",
     "affects_results": true},
    {"name": "start", "type": "choice", "choices": ["empty", "warm"], "default": "empty",
     "description": "Start", "affects_results": true},
    {"name": "output", "type": "text", "default": "", "description": "File", "affects_results": false},
    {"name": "threads", "type": "integer", "minimum": 1, "maximum": 4096, "default": 4, "units": "1",
     "description": "Threads", "affects_results": false}])");
  Example example;
  example.parse({"--sigma", "0.25", "--gamma", "7", "--start", "warm"});  // defaults are those declared
  EXPECT_EQ(example.options.describe(), expected) << example.options.describe().dump(1);
}

struct ConfigFile : testing::Test {
  support::TemporaryFolder folder;
  std::string path = folder / "run.toml";

  void write(const std::string& content) const { support::write_file(path, content); }

  void expect_file_refused(const std::string& content, const std::vector<std::string>& parts) const {
    write(content);
    expect_refused({"--config", path}, parts);
  }
};

TEST_F(ConfigFile, SetsWhatTheCommandLineDoesNot) {
  write(R"(# a comment
sigma = -0.25
cells = 7
start = "warm"
zero-total-momentum = true
output = 'a b.h5'
temperature = 1e3
relaxation-time = 2
gamma = 1.5
sites = "continuum"
window = "2N"
times = [0, 0.1, 2]
)");
  Example example;
  EXPECT_TRUE(example.parse({"--config", path, "--cells", "8"}));
  EXPECT_EQ(example.sigma, -0.25);
  EXPECT_EQ(example.cells, 8U);
  EXPECT_EQ(example.start, "warm");
  EXPECT_TRUE(example.shifted);
  EXPECT_EQ(example.output, "a b.h5");
  EXPECT_EQ(example.temperature, 1000);
  EXPECT_EQ(example.relaxation, 2);
  EXPECT_EQ(example.gamma, 1.5);
  EXPECT_EQ(example.sites, std::nullopt);
  EXPECT_EQ(example.window.at(3), 6);
  EXPECT_EQ(example.times, (std::vector<double>{0, 0.1, 2}));
  EXPECT_EQ(example.seed, 1U);
  EXPECT_TRUE(example.options.given("--sigma"));
  EXPECT_TRUE(example.options.given("--cells"));
  EXPECT_FALSE(example.options.given("--seed"));
}

TEST_F(ConfigFile, TakesWordsNumbersAndListsAsStrings) {
  write("gamma = \"N\"\nsites = 9\nwindow = 4\ntimes = \"1,3\"\nzero-total-momentum = false\n");
  Example example;
  EXPECT_TRUE(example.parse({"--gamma=2", "--config", path}));
  EXPECT_EQ(example.gamma, 2);
  EXPECT_EQ(example.sites, 9U);
  EXPECT_EQ(example.window.at(3), 4);
  EXPECT_EQ(example.times, (std::vector<double>{1, 3}));
  EXPECT_FALSE(example.shifted);
  Example word;
  word.gamma = 5;
  EXPECT_TRUE(word.parse({"--config", path}));
  EXPECT_EQ(word.gamma, std::nullopt);
}

TEST_F(ConfigFile, ReadsNumbersAsTheCompilerDoes) {
  write("sigma = 0.002877\ntemperature = 1e-310\nseed = 9223372036854775807\n");
  Example example;
  EXPECT_TRUE(example.parse({"--config", path}));
  EXPECT_EQ(example.sigma, 0.002877);
  EXPECT_EQ(example.temperature, 1e-310);
  EXPECT_EQ(example.seed, 9223372036854775807U);
}

TEST_F(ConfigFile, MayBeEmpty) {
  write("");
  Example example;
  EXPECT_TRUE(example.parse({"--config", path}));
  EXPECT_EQ(example.sigma, 0.5);
}

TEST_F(ConfigFile, IsRefusedForWhatIsNoOption) {
  expect_file_refused("sigma = 0.5\nsgima = 0.5\n",
                      {path + ", line 2: no option has the name 'sgima'; the nearest one is 'sigma'"});
  expect_file_refused("[section]\nsigma = 0.5\n", {path + ", line 1: no option has the name 'section'"});
  expect_file_refused("config = \"other.toml\"\n", {path + ", line 1: no option has the name 'config'"});
  expect_file_refused("--sigma = 0.5\n", {path + ", line 1: no option has the name '--sigma'"});
  expect_file_refused("help = true\n", {path + ", line 1: no option has the name 'help'"});
}

TEST_F(ConfigFile, IsRefusedForWhatAnOptionCannotBe) {
  const auto refused = [&](const std::string& name, const std::string& value, const std::string& admissible) {
    expect_file_refused(
        "# a comment\n" + name + " = " + value + '\n',
        {path + ", line 2: --" + name + ": '" + value + "' cannot be used: it must be " + admissible});
  };
  for (const char* value : {"2", "nan", "inf", "-inf", "true", "\"0.5\"", "1979-05-27", "0x1"})
    refused("sigma", value, "a number in [-1, 1]");
  expect_file_refused("sigma = [0.5]\n", {"--sigma: '[0.5]'"});
  expect_file_refused("sigma.x = 0.5\n", {"--sigma: '{...}'"});
  for (const char* value : {"0", "0.5", "7.0", "0x10", "\"7\"", "true"})
    refused("cells", value, "a whole number in [1, 100]");
  expect_file_refused("gamma = \"M\"\n", {"--gamma: 'M' cannot", "or N"});
  expect_file_refused("gamma = true\n", {"--gamma: 'true' cannot", "or N"});
  expect_file_refused("sites = 7.0\n", {"--sites: '7.0' cannot", "or continuum"});
  expect_file_refused("start = \"hot\"\n", {"--start: 'hot' cannot", "one of empty, warm"});
  expect_file_refused("start = 1\n", {"--start: '1' cannot", "one of empty, warm"});
  expect_file_refused("output = 5\n", {"--output: '5' cannot be used: it must be a string"});
  expect_file_refused("zero-total-momentum = 1\n", {"--zero-total-momentum: '1' cannot", "true or false"});
  expect_file_refused("zero-total-momentum = \"true\"\n", {"'\"true\"' cannot", "true or false"});
  for (const char* value :
       {"[]", "[2, 1]", "[1, \"2\"]", "[1, [2]]", "[1, nan]", "\"1,2,\"", "\"\"", "[1, 11]"})
    expect_file_refused(std::string("times = ") + value + '\n',
                        {"--times: ", "it must be numbers in [0, 10], ascending"});
}

TEST_F(ConfigFile, IsRefusedWhereItBreaksTheRulesOfToml) {
  const auto broken = [&](const std::string& content, const std::string& place) {
    write(content);
    const std::string message = refusal({"--config", path});
    EXPECT_TRUE(message.starts_with(path + ", " + place)) << message;
    EXPECT_TRUE(message.ends_with(". Correct the file.")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  broken("sigma = [0.25", "line 1, column 14: ");
  broken("cells = 7\nsigma 0.25\n", "line 2, column ");
  broken("cells = 7\nsigma = 0.25 0.5\n", "line 2, column ");
  broken("cells = 7\ncells = 8\n", "line 2, column ");
  broken("sigma = half\n", "line 1, column ");
  broken("sigma = 1e400\n", "line 1, column ");
  broken("start = \"warm\n", "line 1, column ");
  broken("seed = 18446744073709551615\n", "line 1, column ");
  broken("start = \"\xff\"\n", "line 1, column ");
}

TEST_F(ConfigFile, IsRefusedIfItCannotBeRead) {
  const auto unreadable = [](const std::string& name, const std::string& why) {
    EXPECT_EQ(refusal({"--config", name}),
              "--config: '" + name + "' cannot be read: " + why + ". Name a TOML file that can be.");
  };
  unreadable(folder / "absent.toml", "No such file or directory");
  unreadable(folder / "", "it is not a regular file");
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);  // opening it would wait for ever
  unreadable(folder / "fifo", "it is not a regular file");
  unreadable("", "No such file or directory");
  write("");
  unreadable(path + "/run.toml", "Not a directory");
  expect_refused({"--config"}, {"--config needs a value"});
  expect_refused({"--config", path, "--config", path}, {"--config is given more than once"});
}

TEST(Options, HelpListsEveryOptionWithRangeAndDefault) {
  testing::internal::CaptureStdout();
  EXPECT_FALSE(Example().parse({"--help"}));
  const std::string help = testing::internal::GetCapturedStdout();
  for (const char* part : {"--sigma", "in [-1, 1]; default 0.5", "--temperature",
                           "greater than 0; default 500", "--cells", "in [1, 100]; default 11", "--start",
                           "one of empty, warm; default empty", "--seed", "--zero-total-momentum", "--output",
                           "--threads", "--config", "Temperature [temperature] (a number greater",
                           "or N; default N", "default 0.5N", "default 1,2", "or continuum; default 4"})
    EXPECT_NE(help.find(part), std::string::npos) << part;

  testing::internal::CaptureStdout();
  EXPECT_FALSE(Example().parse({"--version"}));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "example 1.0\n");
}

}  // namespace
