// Checkpoints and parts as HDF5 writes them, with objects of any kind, type and shape where records belong.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "fuzz/records.hpp"
#include "program/hdf5_file.hpp"

namespace {

using lorentz::Hdf5Handle;

/// What the fuzzer gives, number by number; 0 after its end.
class Source {
 public:
  explicit Source(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  void fill(std::span<std::uint8_t> bytes) {
    const std::size_t size = std::min(bytes.size(), bytes_.size());
    std::ranges::copy(bytes_.first(size), bytes.begin());
    bytes_ = bytes_.subspan(size);
  }
  std::uint8_t below(std::uint8_t limit) {
    std::uint8_t byte = 0;
    fill({&byte, 1});
    return static_cast<std::uint8_t>(byte % limit);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

Hdf5Handle type_from(Source& source) {
  const std::array numbers{H5T_IEEE_F64LE, H5T_STD_U64LE, H5T_IEEE_F32BE, H5T_STD_I8LE};
  const std::size_t chosen = source.below(numbers.size() + 2);
  if (chosen < numbers.size()) return {H5Tcopy(numbers[chosen]), H5Tclose};
  const hid_t text = H5Tcopy(H5T_C_S1);
  const bool fixed = chosen == numbers.size();
  H5Tset_size(text, fixed ? 1U + source.below(20) : H5T_VARIABLE);
  return {text, H5Tclose};
}

Hdf5Handle space_from(Source& source) {
  const int rank = source.below(5) - 1;
  if (rank < 1) return {H5Screate(rank == 0 ? H5S_SCALAR : H5S_NULL), H5Sclose};
  std::array<hsize_t, 3> size{};
  for (hsize_t& each : size) each = hsize_t{source.below(5)} << (source.below(4) == 0 ? source.below(64) : 0);
  return {H5Screate_simple(rank, size.data(), nullptr), H5Sclose};
}

/// Bytes for all elements; without any if there are none, or too many, or they would be pointers.
std::vector<std::uint8_t> values_from(Source& source, hid_t type, hid_t space) {
  const hssize_t elements = H5Sget_simple_extent_npoints(space);
  if (elements <= 0 || elements > 64 || H5Tis_variable_str(type) > 0) return {};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(elements) * H5Tget_size(type));
  source.fill(bytes);
  return bytes;
}

void make_object(Source& source, hid_t file, const char* path) {
  if (source.below(16) == 1) return;
  if (source.below(16) == 1) {
    H5Gclose(H5Gcreate2(file, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    return;
  }
  const Hdf5Handle type = type_from(source), space = space_from(source);
  const hid_t dataset = H5Dcreate2(file, path, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (dataset < 0) return;
  const std::vector<std::uint8_t> values = values_from(source, type, space);
  if (!values.empty()) H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(dataset);
}

void make_identity(Source& source, hid_t owner) {
  const std::string right = "sigma = 0.5\n";
  const bool is_right = source.below(4) != 1;
  const Hdf5Handle type = is_right ? Hdf5Handle(H5Tcopy(H5T_C_S1), H5Tclose) : type_from(source);
  if (is_right) H5Tset_size(type, right.size());
  const Hdf5Handle space = is_right ? Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose) : space_from(source);
  const hid_t attribute = H5Acreate2(owner, "identity", type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0) return;
  const std::vector<std::uint8_t> values = values_from(source, type, space);
  if (is_right)
    H5Awrite(attribute, type, right.data());
  else if (!values.empty())
    H5Awrite(attribute, type, values.data());
  H5Aclose(attribute);
}

std::string file_from(Source& source) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 12, false);
  const Hdf5Handle file(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  for (const char* group : {"/replicas", "/tallies"}) {
    const Hdf5Handle made(H5Gcreate2(file, group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    make_identity(source, made);
  }
  for (const char* path : {"/replicas/index", "/replicas/events", "/tallies/a", "/tallies/b"})
    make_object(source, file, path);
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  std::string bytes(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)), '\0');
  H5Fget_file_image(file, bytes.data(), bytes.size());
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Source source({data, size});
  fuzz::gives_records(fuzz::with_checksum(file_from(source)));
  return 0;
}
