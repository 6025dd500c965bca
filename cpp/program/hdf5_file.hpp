#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "program/options.hpp"

namespace lorentz {

/// Owner of one HDF5 identifier, closed on destruction.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws NumericalError if the identifier is not valid.
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

/// Builds an HDF5 file in memory, so that one write to the disk succeeds or fails as a whole. Equal calls
/// give equal bytes, because no time stamps are stored. Throws NumericalError if HDF5 fails.
class Hdf5Writer {
 public:
  Hdf5Writer();

  /// Creates a group and the missing groups along its path.
  void group(const std::string& path);
  void dataset(const std::string& path, const Shape& shape, std::span<const double> values);
  void dataset(const std::string& path, const Shape& shape, std::span<const std::uint64_t> values);
  void attribute(const std::string& object, const std::string& name, const AttributeValue& value);

  /// Makes a dataset a named dimension scale.
  void make_scale(const std::string& dataset, const std::string& name);
  /// Attaches a dimension scale to a dimension of a dataset.
  void attach_scale(const std::string& dataset, std::size_t dimension, const std::string& scale);

  /// CRC-32 over the datasets below a group, in ascending order of their paths, as 8 hexadecimal digits: of
  /// each, the path and then the values as they are stored, row-major and little-endian.
  std::string digest(const std::string& group) const;

  /// Bytes of the file.
  std::vector<std::byte> image();

 private:
  void write(const std::string& path, const Shape& shape, hid_t memory_type, hid_t file_type,
             const void* values, std::size_t size);

  /// CRC-32 of a number of bytes.
  struct Checksum {
    unsigned long crc;
    std::size_t bytes;
  };

  Hdf5Handle file_;
  std::map<std::string, Checksum> checksums_;  // of path and values, by path
};

/// Reads files of Hdf5Writer. Throws UsageError, which names the file, if something is missing or otherwise
/// than it was written.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::string& path);

  std::vector<double> doubles(const std::string& dataset) const;
  std::vector<std::uint64_t> counts(const std::string& dataset) const;
  /// None if there is no such attribute, or it has no type that Hdf5Writer writes.
  std::optional<AttributeValue> attribute(const std::string& object, const std::string& name) const;

 private:
  template <class Value>
  std::vector<Value> read(const std::string& dataset, hid_t type_written) const;
  void require(bool as_written, const std::string& object) const;
  /// Their number, if the file has room for them.
  std::size_t elements(hid_t space, std::size_t bytes, const std::string& object) const;

  std::string path_;
  Hdf5Handle file_;
};

}  // namespace lorentz
