#pragma once

#include <hdf5.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "program/options.hpp"
#include "statistics/tally.hpp"

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

/// Builds an HDF5 file in memory. Equal calls give equal bytes, because no time stamps are stored. Throws
/// NumericalError if HDF5 fails.
class Hdf5Writer {
 public:
  Hdf5Writer();

  void group(const std::string& path);

  /// Writes GROUP/NAME, of type double or int64, with its units and description; groups along the path are
  /// created. Axes that axis() has written to the group are attached. Every NaN is written as the same one,
  /// because the sign of 0/0 depends on the processor.
  template <class Value>
  void array(const std::string& group, const Description& what, std::vector<Value> values) {
    if constexpr (std::is_same_v<Value, double>)
      std::ranges::replace_if(
          values, [](double x) { return x != x; }, std::numeric_limits<double>::quiet_NaN());
    write(group, what, std::is_same_v<Value, double> ? H5T_IEEE_F64LE : H5T_STD_I64LE,
          std::as_bytes(std::span(values)));
  }

  /// Writes an axis as a dimension scale.
  void axis(const std::string& group, const Axis& axis);

  void attribute(const std::string& object, const std::string& name, const AttributeValue& value);

  /// Bytes of the file, followed by their CRC-32 as 8 hexadecimal digits, which readers of HDF5 ignore.
  std::vector<std::byte> image();

 private:
  void write(const std::string& group, const Description& what, hid_t type,
             std::span<const std::byte> values);

  Hdf5Handle file_, with_parents_, without_times_;  // and two lists of properties
  std::set<std::string> scales_;                    // paths
};

/// Whether a file ends with the checksum of Hdf5Writer::image(). False if it cannot be read.
bool is_intact(const std::string& path);

/// Reads files of Hdf5Writer. Throws UsageError if the file cannot be read or is not an HDF5 file, and
/// NumericalError if it lacks a dataset.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::string& path);

  std::vector<double> doubles(const std::string& dataset) const;
  std::vector<std::int64_t> counts(const std::string& dataset) const;
  bool has_attribute(const std::string& object, const std::string& name, const AttributeValue& value) const;

 private:
  Hdf5Handle file_;
};

}  // namespace lorentz
