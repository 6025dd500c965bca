#include "program/hdf5_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"
#include "support/temporary_folder.hpp"

namespace hdf5_file_test {

using namespace lorentz;
using support::TemporaryFolder;

constexpr double infinity = std::numeric_limits<double>::infinity();
const std::vector<double> reals = {0.1, -0.0, 5e-324, 1e308, infinity, -infinity};
const std::vector<std::uint64_t> counts = {0, 1, ~std::uint64_t{0}};

/// A file with every kind of object.
std::vector<std::byte> image() {
  Hdf5Writer file;
  file.dataset("/results/profile/mean", {2, 3}, reals);
  file.dataset("/results/profile/count", {3}, counts);
  file.dataset("/results/number", {}, std::vector{0.25});
  file.dataset("/results/nothing", {0}, std::vector<double>{});
  file.group("/parameters");
  file.attribute("/parameters", "flag", true);
  file.attribute("/parameters", "integer", std::int64_t{-3});
  file.attribute("/parameters", "count", std::uint64_t{3});
  file.attribute("/parameters", "real", 0.1);
  file.attribute("/parameters", "text", std::string("\xcf\x83 = 1/2"));  // UTF-8
  file.attribute("/parameters", "empty", std::string());
  file.attribute("/results/number", "units", std::string("1"));
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
  const auto attribute = [&](const char* name) { return file.attribute("/parameters", name).value(); };
  EXPECT_EQ(attribute("flag"), AttributeValue(true));
  EXPECT_EQ(attribute("integer"), AttributeValue(std::int64_t{-3}));
  EXPECT_EQ(attribute("count"), AttributeValue(std::uint64_t{3}));
  EXPECT_EQ(attribute("real"), AttributeValue(0.1));
  EXPECT_EQ(attribute("text"), AttributeValue(std::string("\xcf\x83 = 1/2")));
  EXPECT_EQ(attribute("empty"), AttributeValue(std::string()));
  EXPECT_FALSE(file.attribute("/parameters", "absent"));
}

// The checksums of Python's zlib.crc32 over path and bytes, one dataset after another.
TEST(Hdf5File, DigestsDatasetsInTheOrderOfTheirPaths) {
  const auto digest = [](double value) {
    Hdf5Writer file;
    file.dataset("/results/b", {2}, std::vector{1.0, value});
    file.dataset("/results/a/c", {}, std::vector<std::uint64_t>{7});
    file.dataset("/results2/a", {}, std::vector{3.0});
    return file.digest("/results");
  };
  EXPECT_EQ(digest(2), "fe45c3be");
  EXPECT_NE(digest(2.0000000000000004), digest(2));
}

TEST(Hdf5File, NeedsNoGroup) {
  Hdf5Writer writer;
  EXPECT_NO_THROW(writer.dataset("/number", {}, std::vector{1.0}));
}

TEST(Hdf5File, KeepsNaN) {
  const TemporaryFolder folder;
  Hdf5Writer writer;
  writer.dataset("/group/x", {}, std::vector{std::nan("")});
  write_atomically(folder / "a.h5", writer.image());
  EXPECT_TRUE(std::isnan(Hdf5Reader(folder / "a.h5").doubles("/group/x").at(0)));
}

// Checked with the HDF5 library: a number is a 0-d dataset, not an array of one element.
TEST(Hdf5File, GivesDatasetsTheirShape) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.h5", image());
  const Hdf5Handle file(H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const auto shape = [&file](const char* path) {
    const Hdf5Handle dataset(H5Dopen2(file, path, H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
    std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    if (!size.empty()) H5Sget_simple_extent_dims(space, size.data(), nullptr);
    return size;
  };
  EXPECT_EQ(shape("/results/number"), std::vector<hsize_t>{});
  EXPECT_EQ(shape("/results/profile/mean"), (std::vector<hsize_t>{2, 3}));
  EXPECT_EQ(shape("/results/nothing"), std::vector<hsize_t>{0});
}

// HDF5 time stamps have a resolution of one second.
TEST(Hdf5File, HasTheSameBytesAtAnotherTime) {
  const std::vector<std::byte> first = image();
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_EQ(image(), first);
}

TEST(Hdf5File, RefusesASizeThatIsNotThatOfTheShape) {
  Hdf5Writer file;
  EXPECT_THROW(file.dataset("/group/x", {2, 2}, reals), std::invalid_argument);
  EXPECT_THROW(file.dataset("/group/x", {}, reals), std::invalid_argument);
  EXPECT_THROW(file.dataset("/group/x", {1}, std::vector<double>{}), std::invalid_argument);
}

TEST(Hdf5File, ReportsFailuresOfTheLibrary) {
  Hdf5Writer file;
  file.dataset("/group/x", {}, std::vector{1.0});
  EXPECT_THROW(file.dataset("/group/x", {}, std::vector{2.0}), NumericalError);  // exists
  EXPECT_THROW(file.attribute("/missing", "units", std::string("1")), NumericalError);
}

/// Whether reading fails with a message that names the file and the missing part.
template <class Read>
void expect_complaint(const Read& read, const std::string& path, const std::string& part) {
  try {
    read();
    FAIL() << "no complaint about " << part;
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Hdf5File, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write_atomically(path, image());
  const Hdf5Reader file(path);
  expect_complaint([&] { (void)file.doubles("/results/absent"); }, path, "/results/absent");
  const std::string other = folder / "b.h5";
  support::write_file(other, "not HDF5");
  expect_complaint([&] { Hdf5Reader{other}; }, other, "HDF5");
  expect_complaint([&] { Hdf5Reader{folder / "absent.h5"}; }, folder / "absent.h5", "HDF5");
}

// Found by fuzzing: what such a file says of its sizes was believed, and memory behind a text overwritten.
TEST(Hdf5File, OfOtherObjectsThanThoseWrittenIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  {
    const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const hsize_t enormous = hsize_t{1} << 60, three = 3;
    const Hdf5Handle huge(H5Screate_simple(1, &enormous, nullptr), H5Sclose);
    const Hdf5Handle triple(H5Screate_simple(1, &three, nullptr), H5Sclose);
    const Hdf5Handle one(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle pointer(H5Tcopy(H5T_C_S1), H5Tclose), letters(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(pointer, H5T_VARIABLE);
    H5Tset_size(letters, 100);
    const auto dataset = [&](const char* name, hid_t type, hid_t space) {
      const Hdf5Handle made(H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                            H5Dclose);
    };
    const auto attribute = [&](const char* name, hid_t type, hid_t space) {
      const Hdf5Handle made(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    };
    dataset("/enormous", H5T_IEEE_F64LE, huge);
    dataset("/real", H5T_IEEE_F64LE, one);
    attribute("texts", letters, triple);
    attribute("pointer", pointer, one);
  }
  const Hdf5Reader file(path);
  EXPECT_ANY_THROW((void)file.doubles("/enormous"));
  expect_complaint([&] { (void)file.counts("/real"); }, path, "/real");
  EXPECT_FALSE(file.attribute("/", "texts"));
  EXPECT_FALSE(file.attribute("/", "pointer"));
}

}  // namespace hdf5_file_test
