#include "program/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <stdexcept>

#include "program/errors.hpp"

namespace lorentz {
namespace {

void check(herr_t status, const char* what) {
  if (status < 0) throw NumericalError(fmt::format("HDF5 could not {}", what));
}

std::vector<hsize_t> dimensions(const Shape& shape) { return {shape.begin(), shape.end()}; }

Hdf5Handle dataspace(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> size = dimensions(shape);
  return {H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose};
}

Hdf5Handle memory_file() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are thrown, not printed
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = 1 << 16;
  check(H5Pset_fapl_core(access, growth, false), "use memory as a file");
  check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), "fix the format version");
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(creation, false), "switch time stamps off");
  return {H5Fcreate("in memory", H5F_ACC_TRUNC, creation, access), H5Fclose};
}

Hdf5Handle open_file(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0)
    throw UsageError(fmt::format("'{}' cannot be read: it is not a complete HDF5 file. Remove it.", path));
  return {id, H5Fclose};
}

Hdf5Handle without_times(hid_t property_class) {
  const hid_t properties = H5Pcreate(property_class);
  check(H5Pset_obj_track_times(properties, false), "switch time stamps off");
  return {properties, H5Pclose};
}

/// The type that Python's h5py reads as bool.
Hdf5Handle boolean_type() {
  const hid_t type = H5Tenum_create(H5T_STD_I8LE);
  const std::int8_t no = 0, yes = 1;
  H5Tenum_insert(type, "FALSE", &no);
  H5Tenum_insert(type, "TRUE", &yes);
  return {type, H5Tclose};
}

Hdf5Handle text_type(std::size_t size) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(size, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return {type, H5Tclose};
}

void write_attribute(hid_t object, const std::string& name, hid_t memory_type, hid_t file_type,
                     const void* value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  check(H5Awrite(attribute, memory_type, value), "write an attribute");
}

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {
  if (id < 0) throw NumericalError("HDF5 refused to make or open an object");
}

Hdf5Writer::Hdf5Writer() : file_(memory_file()) {}

void Hdf5Writer::group(const std::string& path) {
  if (path.empty() || path == "/" || H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0) return;
  const std::size_t slash = path.rfind('/');
  if (slash != 0) group(path.substr(0, slash));
  const Hdf5Handle group(
      H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, without_times(H5P_GROUP_CREATE), H5P_DEFAULT), H5Gclose);
}

void Hdf5Writer::write(const std::string& path, const Shape& shape, hid_t memory_type, hid_t file_type,
                       const void* values, std::size_t size) {
  if (size != std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()))
    throw std::invalid_argument(fmt::format("{} does not have the size of its shape", path));
  group(path.substr(0, path.rfind('/')));
  const Hdf5Handle space = dataspace(shape);
  const Hdf5Handle dataset(H5Dcreate2(file_, path.c_str(), file_type, space, H5P_DEFAULT,
                                      without_times(H5P_DATASET_CREATE), H5P_DEFAULT),
                           H5Dclose);
  if (size > 0)
    check(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write a dataset");
  static_assert(std::endian::native == std::endian::little, "values are stored as they are in memory");
  const std::size_t bytes = size * H5Tget_size(memory_type);
  const auto crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(path.data()), path.size());
  checksums_[path] = {::crc32_z(crc, static_cast<const Bytef*>(values), bytes), path.size() + bytes};
}

std::string Hdf5Writer::digest(const std::string& group) const {
  unsigned long digest = 0;
  for (const auto& [path, checksum] : checksums_)
    if (path.starts_with(group + '/'))
      digest = ::crc32_combine(digest, checksum.crc, static_cast<z_off_t>(checksum.bytes));
  return fmt::format("{:08x}", digest);
}

void Hdf5Writer::dataset(const std::string& path, const Shape& shape, std::span<const double> values) {
  write(path, shape, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, values.data(), values.size());
}

void Hdf5Writer::dataset(const std::string& path, const Shape& shape, std::span<const std::uint64_t> values) {
  write(path, shape, H5T_NATIVE_UINT64, H5T_STD_U64LE, values.data(), values.size());
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const AttributeValue& value) {
  const Hdf5Handle owner(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose);
  if (const auto* truth = std::get_if<bool>(&value)) {
    const Hdf5Handle type = boolean_type();
    const std::int8_t byte = *truth ? 1 : 0;
    write_attribute(owner, name, type, type, &byte);
  } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    write_attribute(owner, name, H5T_NATIVE_INT64, H5T_STD_I64LE, integer);
  } else if (const auto* count = std::get_if<std::uint64_t>(&value)) {
    write_attribute(owner, name, H5T_NATIVE_UINT64, H5T_STD_U64LE, count);
  } else if (const auto* real = std::get_if<double>(&value)) {
    write_attribute(owner, name, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, real);
  } else {
    const auto& text = std::get<std::string>(value);
    const Hdf5Handle type = text_type(text.size());
    write_attribute(owner, name, type, type, text.c_str());
  }
}

void Hdf5Writer::make_scale(const std::string& dataset, const std::string& name) {
  const Hdf5Handle scale(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  check(H5DSset_scale(scale, name.c_str()), "make a dimension scale");
}

void Hdf5Writer::attach_scale(const std::string& dataset, std::size_t dimension, const std::string& scale) {
  const Hdf5Handle array(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle axis(H5Dopen2(file_, scale.c_str(), H5P_DEFAULT), H5Dclose);
  check(H5DSattach_scale(array, axis, static_cast<unsigned>(dimension)), "attach a dimension scale");
}

std::vector<std::byte> Hdf5Writer::image() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "complete a file");
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  check(size < 0 ? -1 : 0, "give the size of a file");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  check(H5Fget_file_image(file_, bytes.data(), bytes.size()) < 0 ? -1 : 0, "give the bytes of a file");
  return bytes;
}

Hdf5Reader::Hdf5Reader(const std::string& path) : path_(path), file_(open_file(path)) {}

void Hdf5Reader::require(bool as_written, const std::string& object) const {
  if (!as_written)
    throw UsageError(
        fmt::format("'{}' is damaged: {} is not as this program writes it. Remove it.", path_, object));
}

std::size_t Hdf5Reader::elements(hid_t space, std::size_t bytes, const std::string& object) const {
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  hsize_t size = 0;
  require(count >= 0 && H5Fget_filesize(file_, &size) >= 0 && static_cast<hsize_t>(count) <= size / bytes,
          object);
  return static_cast<std::size_t>(count);
}

template <class Value>
std::vector<Value> Hdf5Reader::read(const std::string& dataset, hid_t type_written) const {
  const hid_t id = H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT);
  if (id < 0) throw UsageError(fmt::format("'{}' has no dataset {}.", path_, dataset));
  const Hdf5Handle handle(id, H5Dclose);
  const Hdf5Handle type(H5Dget_type(handle), H5Tclose);
  require(H5Tequal(type, type_written) > 0, dataset);
  const Hdf5Handle space(H5Dget_space(handle), H5Sclose);
  std::vector<Value> values(elements(space, sizeof(Value), dataset));
  if (!values.empty())
    require(H5Dread(handle, type_written, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, dataset);
  return values;
}

std::vector<double> Hdf5Reader::doubles(const std::string& dataset) const {
  return read<double>(dataset, H5T_IEEE_F64LE);
}

std::vector<std::uint64_t> Hdf5Reader::counts(const std::string& dataset) const {
  return read<std::uint64_t>(dataset, H5T_STD_U64LE);
}

std::optional<AttributeValue> Hdf5Reader::attribute(const std::string& object,
                                                    const std::string& name) const {
  if (H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  require(elements(space, H5Tget_size(type), name) == 1, name);
  const auto read = [&](auto value) {
    require(H5Aread(attribute, type, &value) >= 0, name);
    return value;
  };
  if (H5Tequal(type, H5T_IEEE_F64LE) > 0) return read(double{});
  if (H5Tequal(type, H5T_STD_I64LE) > 0) return read(std::int64_t{});
  if (H5Tequal(type, H5T_STD_U64LE) > 0) return read(std::uint64_t{});
  if (H5Tequal(type, boolean_type()) > 0) return read(std::int8_t{}) != 0;
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) return {};
  std::string text(H5Tget_size(type), '\0');
  require(H5Aread(attribute, type, text.data()) >= 0, name);
  return text.substr(0, text.find('\0'));
}

}  // namespace lorentz
