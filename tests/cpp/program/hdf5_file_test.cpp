#include "program/hdf5_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace hdf5_file_test {

using namespace lorentz;
using support::TemporaryFolder;

const std::vector<double> reals = {0.1, -0.0, 5e-324, 1e308, INFINITY, -INFINITY};
const std::vector<std::int64_t> counts = {0, -1, std::numeric_limits<std::int64_t>::max()};
const std::vector<Parameter> parameters = {{"flag", true},
                                           {"integer", std::int64_t{-3}},
                                           {"real", 0.1},
                                           {"text", std::string("\xcf\x83 = 1/2")},
                                           {"empty", std::string()}};  // UTF-8

Axis axis(const std::string& name, std::size_t size) { return numbered_axis(name, "An axis", size); }

/// A file with every kind of object.
std::vector<std::byte> image() {
  Hdf5Writer file;
  const Axis row = axis("row", 2), column = axis("column", 3);
  for (const Axis& each : {row, column}) file.axis("/results/profile", each);
  file.array("/results/profile", {"mean", "time", "A profile", {row, column}}, reals);
  file.array("/results/profile", {"count", "1", "Numbers", {column}}, counts);
  file.array("/results", {"number", "1", "A number"}, std::vector{0.25});
  file.array("/results", {"nothing", "1", "Nothing", {axis("none", 0)}}, std::vector<double>{});
  file.group("/parameters");
  for (const Parameter& each : parameters) file.attribute("/parameters", each.name, each.value);
  return file.image();
}

TEST(Hdf5File, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.h5", image());
  const Hdf5Reader file(folder / "a.h5");
  const std::vector<double> read = file.doubles("/results/profile/mean");
  EXPECT_EQ(read, reals);
  EXPECT_TRUE(std::signbit(read.at(1)));
  EXPECT_EQ(file.counts("/results/profile/count"), counts);
  EXPECT_EQ(file.doubles("/results/number"), std::vector{0.25});
  EXPECT_TRUE(file.doubles("/results/nothing").empty());
  EXPECT_TRUE(file.has_attribute("/results/profile/mean", "units", std::string("time")));
  for (const Parameter& a : parameters)
    for (const Parameter& b : parameters)
      EXPECT_EQ(file.has_attribute("/parameters", a.name, b.value), a.name == b.name) << a.name << b.name;
  EXPECT_FALSE(file.has_attribute("/parameters", "text", std::string("\xcf\x83 = 1/")));
  EXPECT_FALSE(file.has_attribute("/parameters", "absent", true));
}

// Detected mistakes: a part of the file is not in the checksum.
TEST(Hdf5File, AChangeOfAnyByteChangesTheChecksum) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  std::vector<std::byte> content = image();
  write_atomically(path, content);
  EXPECT_TRUE(is_intact(path));
  for (std::size_t place = 0; place < content.size(); place += 97) {
    content[place] ^= std::byte{1};
    write_atomically(path, content);
    EXPECT_FALSE(is_intact(path)) << place;
    content[place] ^= std::byte{1};
  }
  write_atomically(path, {});
  EXPECT_FALSE(is_intact(path));
}

TEST(Hdf5File, RefusesMissingDatasetsAndOtherFiles) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5", other = folder / "b.h5";
  write_atomically(path, image());
  EXPECT_THROW((void)Hdf5Reader(path).doubles("/results/absent"), NumericalError);
  support::write_file(other, "not HDF5");
  EXPECT_NE(support::refusal([&] { Hdf5Reader{other}; }), "");
  EXPECT_NE(support::refusal([&] { Hdf5Reader{folder / "absent.h5"}; }), "");
  std::filesystem::create_directory(folder / "c.h5");
  EXPECT_NE(support::refusal([&] { require_writable(folder / "c.h5"); }), "");
}

}  // namespace hdf5_file_test
