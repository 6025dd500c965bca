#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <variant>
#include <vector>

#include "support/example_options.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace lorentz;
using namespace support;

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

// Found by fuzzing: an assertion of toml++ ended the process, and its search for blanks has no answer for
// letters.
TEST_F(ConfigFile, IsRefusedWhereTheLibraryIsAtALoss) {
  write("[ = 1");
  EXPECT_TRUE(refusal({"--config", path}).find("it breaks the rules of TOML") != std::string::npos);
  for (const std::string content : {"\xc3\xa9 = 1", "sigma\xef\xbb\xbb = 1"}) {
    write(content);
    EXPECT_TRUE(refusal({"--config", path}).starts_with(path + ", line 1, column ")) << content;
  }
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

}  // namespace
