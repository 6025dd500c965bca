#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "statistics/description.hpp"

namespace lorentz {

/// Handle of an array in the record of a replica: its first column and its size.
struct Tally {
  std::size_t first, size;
};

/// Handle of a number in the record of a replica.
struct ScalarTally {
  std::size_t column;

  /// A number is an array of size 1.
  operator Tally() const { return {column, 1}; }  // NOLINT(cppcoreguidelines-explicit-constructor)
};

/// Columns of records.
using Columns = std::vector<std::size_t>;

inline Columns columns_of(std::initializer_list<Tally> tallies) {
  Columns columns;
  for (const Tally& tally : tallies)
    for (std::size_t i = 0; i < tally.size; ++i) columns.push_back(tally.first + i);
  return columns;
}

/// Tallies of a replica: their descriptions and columns. An observable derives its tallies from this class;
/// each is declared once, and its handle is the only access to its values in Record and RecordView.
class TallySchema {
 public:
  /// Declares an array. A tally is averaged over replicas, so it must be a sum, not a ratio.
  Tally tally(const std::string& name, const std::vector<Axis>& axes, const std::string& units,
              const std::string& description) {
    tallies_.push_back({name, units, description, axes});
    return {std::exchange(width_, width_ + tallies_.back().size()), tallies_.back().size()};
  }

  ScalarTally tally(const std::string& name, const std::string& units, const std::string& description) {
    return {tally(name, {}, units, description).first};
  }

  std::size_t width() const { return width_; }
  const std::vector<Description>& tallies() const { return tallies_; }

 private:
  std::vector<Description> tallies_;
  std::size_t width_ = 0;
};

/// Record of a replica, initially 0.
class Record {
 public:
  explicit Record(const TallySchema& schema) : values_(schema.width()) {}

  double& operator[](ScalarTally tally) { return values_[tally.column]; }
  std::span<double> operator[](Tally tally) { return std::span(values_).subspan(tally.first, tally.size); }

  /// Sets an array. Throws std::out_of_range unless the sizes agree.
  void set(Tally tally, std::span<const double> values) {
    if (values.size() != tally.size) throw std::out_of_range("values of another size than the tally");
    std::ranges::copy(values, values_.begin() + static_cast<std::ptrdiff_t>(tally.first));
  }

  const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> values_;
};

/// Read-only view of the mean record of replicas, or of one record.
class RecordView {
 public:
  // NOLINTNEXTLINE(cppcoreguidelines-explicit-constructor): any record, of whatever type, can be viewed
  RecordView(std::span<const double> values) : values_(values) {}

  double operator[](ScalarTally tally) const { return values_[tally.column]; }
  std::span<const double> operator[](Tally tally) const { return values_.subspan(tally.first, tally.size); }

 private:
  std::span<const double> values_;
};

}  // namespace lorentz
