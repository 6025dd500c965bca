#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "program/options.hpp"

namespace lorentz {

/// Owner of one HDF5 identifier. Throws NumericalError if the identifier is not valid.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle(hid_t id, Close close);
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() { close_(id_); }
  operator hid_t() const { return id_; }  // NOLINT(cppcoreguidelines-explicit-constructor): used as one

 private:
  hid_t id_;
  Close close_;
};

using Shape = std::vector<std::size_t>;  // empty for a 0-d dataset

/// Builds an HDF5 file in memory. Equal calls give equal bytes, because no time stamps are stored. Throws
/// NumericalError if HDF5 fails.
class Hdf5Writer {
 public:
  Hdf5Writer();

  /// Datasets and attributes; groups along the path are created.
  void dataset(const std::string& path, const Shape& shape, std::span<const double> values);
  void dataset(const std::string& path, const Shape& shape, std::span<const std::uint64_t> values);
  void attribute(const std::string& object, const std::string& name, const AttributeValue& value);
  void group(const std::string& path);

  /// Makes a dataset a named dimension scale, and attaches it to a dimension of another.
  void make_scale(const std::string& dataset, const std::string& name);
  void attach_scale(const std::string& dataset, std::size_t dimension, const std::string& scale);

  /// CRC-32 over the datasets below a group, in ascending order of their paths, as 8 hexadecimal digits: of
  /// each, the path and then the values as they are stored, row-major and little-endian.
  std::string digest(const std::string& group) const;

  std::vector<std::byte> image();  // bytes of the file

 private:
  void write(const std::string& path, const Shape& shape, hid_t type, std::span<const std::byte> values);

  struct Checksum {
    unsigned long crc;
    std::size_t bytes;
  };
  Hdf5Handle file_;
  std::map<std::string, Checksum> checksums_;  // of path and values, by path
};

/// Reads files of Hdf5Writer. Throws UsageError, which names the file, if it is not as written.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::string& path);

  std::vector<double> doubles(const std::string& dataset) const;
  std::vector<std::uint64_t> counts(const std::string& dataset) const;
  /// None if there is no such attribute, or it is not of a type that Hdf5Writer writes.
  std::optional<AttributeValue> attribute(const std::string& object, const std::string& name) const;

 private:
  template <class Value>
  std::vector<Value> read(const std::string& dataset, hid_t type) const;

  std::string path_;
  Hdf5Handle file_;
};

/// CRC-32 as 8 hexadecimal digits.
std::string crc32_of(std::span<const std::byte> content);

}  // namespace lorentz
