#include "program/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "program/errors.hpp"

namespace lorentz {
namespace {

static_assert(std::endian::native == std::endian::little, "values are stored as they are in memory");

void check(herr_t status) {
  if (status < 0) throw NumericalError("HDF5 could not read or write an object");
}

constexpr std::size_t digits = 8;  // of a checksum

/// CRC-32 as hexadecimal digits.
std::string checksum(std::span<const std::byte> content) {
  return fmt::format("{:08x}", ::crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size()));
}

hid_t memory_file() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are thrown, not printed
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = 1 << 16;
  check(H5Pset_fapl_core(access, growth, false));
  check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18));
  return H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

/// Opens a file also where another process has locked it, because files are replaced and not changed.
hid_t open_file(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_file_locking(access, false, true));
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (id < 0)
    throw UsageError(fmt::format(
        "'{}' cannot be read, or is not a complete HDF5 file. Name another, or replace it with --overwrite.",
        path));
  return id;
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
  return {H5Tcopy(std::holds_alternative<double>(value) ? H5T_IEEE_F64LE : H5T_STD_I64LE), H5Tclose};
}

/// An empty text is a null byte, as no type has the size 0.
std::span<const std::byte> data_of(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    return std::as_bytes(std::span(text->c_str(), std::max<std::size_t>(text->size(), 1)));
  return std::visit([](const auto& number) { return std::as_bytes(std::span(&number, 1)); }, value);
}

template <class Value>
std::vector<Value> read(hid_t file, const std::string& path, hid_t type) {
  const Hdf5Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<Value> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return values;
}

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {
  if (id < 0) throw NumericalError("HDF5 could not create or open an object");
}

Hdf5Writer::Hdf5Writer()
    : file_(memory_file(), H5Fclose),
      with_parents_(H5Pcreate(H5P_LINK_CREATE), H5Pclose),
      without_times_(H5Pcreate(H5P_DATASET_CREATE), H5Pclose) {
  check(H5Pset_create_intermediate_group(with_parents_, 1));
  check(H5Pset_obj_track_times(without_times_, false));
}

void Hdf5Writer::group(const std::string& path) {
  const Hdf5Handle made(H5Gcreate2(file_, path.c_str(), with_parents_, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
}

void Hdf5Writer::write(const std::string& group, const Description& what, hid_t type,
                       std::span<const std::byte> values) {
  const std::string path = group + '/' + what.name;
  if (what.size() * H5Tget_size(type) != values.size())
    throw std::invalid_argument(fmt::format("{} does not have the size of its axes", path));
  std::vector<hsize_t> shape;
  for (const Axis& axis : what.axes) shape.push_back(axis.values.size());
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Hdf5Handle dataset(
      H5Dcreate2(file_, path.c_str(), type, space, with_parents_, without_times_, H5P_DEFAULT), H5Dclose);
  if (!values.empty()) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  attribute(path, "units", what.units);
  attribute(path, "description", what.description);
  for (unsigned i = 0; i < shape.size(); ++i) {
    const std::string axis = group + '/' + what.axes[i].name;
    if (!scales_.contains(axis)) continue;
    const Hdf5Handle scale(H5Dopen2(file_, axis.c_str(), H5P_DEFAULT), H5Dclose);
    check(H5DSattach_scale(dataset, scale, i));
  }
}

void Hdf5Writer::axis(const std::string& group, const Axis& axis) {
  array(group, {axis.name, axis.units, axis.description, {axis}}, axis.values);
  const std::string& path = *scales_.insert(group + '/' + axis.name).first;
  const Hdf5Handle scale(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  check(H5DSset_scale(scale, axis.name.c_str()));
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const AttributeValue& value) {
  const Hdf5Handle type = type_of(value), space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                               H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  check(H5Awrite(attribute, type, data_of(value).data()));
}

std::vector<std::byte> Hdf5Writer::image() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL));
  std::vector<std::byte> bytes(static_cast<std::size_t>(H5Fget_file_image(file_, nullptr, 0)));
  check(H5Fget_file_image(file_, bytes.data(), bytes.size()) < 0 ? -1 : 0);
  const std::string sum = checksum(bytes);
  bytes.insert(bytes.end(), std::as_bytes(std::span(sum)).begin(), std::as_bytes(std::span(sum)).end());
  return bytes;
}

bool is_intact(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.size() >= digits &&
         text.ends_with(checksum(std::as_bytes(std::span(text).first(text.size() - digits))));
}

Hdf5Reader::Hdf5Reader(const std::string& path) : file_(open_file(path), H5Fclose) {}

std::vector<double> Hdf5Reader::doubles(const std::string& dataset) const {
  return read<double>(file_, dataset, H5T_IEEE_F64LE);
}

std::vector<std::int64_t> Hdf5Reader::counts(const std::string& dataset) const {
  return read<std::int64_t>(file_, dataset, H5T_STD_I64LE);
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name,
                               const AttributeValue& value) const {
  const Hdf5Handle type = type_of(value);
  std::vector<std::byte> stored(H5Tget_size(type));
  H5T_class_t kind{};
  std::size_t size = 0;
  return H5LTget_attribute_info(file_, object.c_str(), name.c_str(), nullptr, &kind, &size) >= 0 &&
         size == stored.size() &&
         H5LTget_attribute(file_, object.c_str(), name.c_str(), type, stored.data()) >= 0 &&
         std::ranges::equal(stored, data_of(value));
}

}  // namespace lorentz
