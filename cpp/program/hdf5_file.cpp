#include "program/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "program/errors.hpp"

namespace lorentz {
namespace {

static_assert(std::endian::native == std::endian::little, "values are stored as they are in memory");

void check(herr_t status) {
  if (status < 0) throw NumericalError("HDF5 could not write a result");
}

Hdf5Handle memory_file() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are thrown, not printed
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose),
      creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  constexpr std::size_t growth = 1 << 16;
  check(H5Pset_fapl_core(access, growth, false));
  check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18));
  check(H5Pset_obj_track_times(creation, false));
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
  check(H5Pset_obj_track_times(properties, false));
  return {properties, H5Pclose};
}

/// A bool has the type that Python's h5py reads as one, a string is padded with null bytes.
Hdf5Handle type_of(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, std::max<std::size_t>(text->size(), 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return {type, H5Tclose};
  }
  if (std::holds_alternative<bool>(value)) {
    const hid_t type = H5Tenum_create(H5T_STD_I8LE);
    const std::int8_t no = 0, yes = 1;
    H5Tenum_insert(type, "FALSE", &no);
    H5Tenum_insert(type, "TRUE", &yes);
    return {type, H5Tclose};
  }
  const bool real = std::holds_alternative<double>(value),
             count = std::holds_alternative<std::uint64_t>(value);
  return {H5Tcopy(real ? H5T_IEEE_F64LE : count ? H5T_STD_U64LE : H5T_STD_I64LE), H5Tclose};
}

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {
  if (id < 0) throw NumericalError("HDF5 refused to make or open an object");
}

Hdf5Writer::Hdf5Writer() : file_(memory_file()) {}

void Hdf5Writer::group(const std::string& path) {
  if (path.empty() || H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0) return;
  group(path.substr(0, path.rfind('/')));
  const Hdf5Handle made(
      H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, without_times(H5P_GROUP_CREATE), H5P_DEFAULT), H5Gclose);
}

void Hdf5Writer::write(const std::string& path, const Shape& shape, hid_t type,
                       std::span<const std::byte> values) {
  group(path.substr(0, path.rfind('/')));
  const std::vector<hsize_t> size{shape.begin(), shape.end()};
  const Hdf5Handle space(shape.empty()
                             ? H5Screate(H5S_SCALAR)
                             : H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                         H5Sclose);
  if (static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * H5Tget_size(type) != values.size())
    throw std::invalid_argument(fmt::format("{} does not have the size of its shape", path));
  const Hdf5Handle dataset(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT,
                                      without_times(H5P_DATASET_CREATE), H5P_DEFAULT),
                           H5Dclose);
  if (!values.empty()) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  const auto crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(path.data()), path.size());
  checksums_[path] = {::crc32_z(crc, reinterpret_cast<const Bytef*>(values.data()), values.size()),
                      path.size() + values.size()};
}

void Hdf5Writer::dataset(const std::string& path, const Shape& shape, std::span<const double> values) {
  write(path, shape, H5T_IEEE_F64LE, std::as_bytes(values));
}

void Hdf5Writer::dataset(const std::string& path, const Shape& shape, std::span<const std::uint64_t> values) {
  write(path, shape, H5T_STD_U64LE, std::as_bytes(values));
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const AttributeValue& value) {
  const Hdf5Handle type = type_of(value), space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                               H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  const auto* text = std::get_if<std::string>(&value);
  const void* data = std::visit([](const auto& each) -> const void* { return &each; }, value);
  check(H5Awrite(attribute, type, text ? text->c_str() : data));
}

void Hdf5Writer::make_scale(const std::string& dataset, const std::string& name) {
  const Hdf5Handle scale(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  check(H5DSset_scale(scale, name.c_str()));
}

void Hdf5Writer::attach_scale(const std::string& dataset, std::size_t dimension, const std::string& scale) {
  const Hdf5Handle array(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle axis(H5Dopen2(file_, scale.c_str(), H5P_DEFAULT), H5Dclose);
  check(H5DSattach_scale(array, axis, static_cast<unsigned>(dimension)));
}

std::string Hdf5Writer::digest(const std::string& group) const {
  unsigned long digest = 0;
  for (const auto& [path, checksum] : checksums_)
    if (path.starts_with(group + '/'))
      digest = ::crc32_combine(digest, checksum.crc, static_cast<z_off_t>(checksum.bytes));
  return fmt::format("{:08x}", digest);
}

std::vector<std::byte> Hdf5Writer::image() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL));
  std::vector<std::byte> bytes(static_cast<std::size_t>(H5Fget_file_image(file_, nullptr, 0)));
  check(H5Fget_file_image(file_, bytes.data(), bytes.size()) < 0 ? -1 : 0);
  return bytes;
}

Hdf5Reader::Hdf5Reader(const std::string& path) : path_(path), file_(open_file(path)) {}

template <class Value>
std::vector<Value> Hdf5Reader::read(const std::string& dataset, hid_t type) const {
  try {
    const Hdf5Handle handle(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(handle), H5Sclose), stored(H5Dget_type(handle), H5Tclose);
    std::vector<Value> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    check(H5Tequal(stored, type) > 0 ? 0 : -1);
    check(H5Dread(handle, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
  } catch (const NumericalError&) {
    throw UsageError(
        fmt::format("'{}' has no dataset {} as this program writes it. Remove it.", path_, dataset));
  }
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
  if (H5Sget_simple_extent_npoints(space) != 1) return {};
  std::string text(H5Tget_size(type), '\0');
  for (AttributeValue value : {AttributeValue(false), AttributeValue(std::int64_t{}),
                               AttributeValue(std::uint64_t{}), AttributeValue(0.0), AttributeValue(text)}) {
    if (H5Tequal(type, type_of(value)) <= 0) continue;
    void* data = std::visit([](auto& each) -> void* { return &each; }, value);
    const bool is_text = std::holds_alternative<std::string>(value);
    if (H5Aread(attribute, type, is_text ? text.data() : data) < 0) return {};
    if (is_text) value = text.substr(0, text.find('\0'));
    return value;
  }
  return {};
}

std::string crc32_of(std::span<const std::byte> content) {
  return fmt::format("{:08x}", ::crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size()));
}

}  // namespace lorentz
