#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz {

/// Coordinates along one dimension of an array.
struct Axis {
  std::string name;
  std::string units;
  std::string description;
  std::vector<double> values;
};

/// Axis of the integers first, first + 1, ...
Axis numbered_axis(std::string_view name, std::string_view description, std::size_t count, double first = 0);

/// Name, units and shape of a tally or a quantity: a number, or a row-major array with one dimension per
/// axis.
struct Description {
  std::string name;
  std::string units;
  std::string description;
  std::vector<Axis> axes{};  // none for a number

  std::size_t size() const;
};

/// Handle of an array in the tallies of a replica.
struct Tally {
  std::size_t first, size;  // first column, number of columns
  std::size_t stride = 1;   // columns per step of the first index

  /// Part of an array with two axes: all values at the index i of the first.
  Tally row(std::size_t i) const { return {first + i * stride, stride}; }
};

/// Handle of a number in the tallies of a replica.
struct ScalarTally {
  std::size_t column;

  /// A number is an array of size 1.
  operator Tally() const { return {column, 1}; }  // NOLINT(cppcoreguidelines-explicit-constructor)
};

/// Columns of records.
using Columns = std::vector<std::size_t>;

Columns columns_of(std::initializer_list<Tally> tallies);

/// Tallies of a replica: their descriptions and columns. An observable derives its tallies from this class;
/// each is declared once, and its handle is the only access to its values in TallySums and TallyMeans.
class TallySchema {
 public:
  /// Declares an array. A tally is averaged over replicas, so it must be a sum, not a ratio.
  Tally tally(std::string_view name, const std::vector<Axis>& axes, std::string_view units,
              std::string_view description);
  ScalarTally tally(std::string_view name, std::string_view units, std::string_view description);

  std::size_t width() const { return width_; }
  const std::vector<Description>& tallies() const { return tallies_; }
  /// Throws std::logic_error for a tally of another schema.
  const Description& description(Tally tally) const;

 private:
  std::vector<Description> tallies_;
  std::size_t width_ = 0;
};

/// Values of the tallies of one replica, initially 0.
class TallySums {
 public:
  explicit TallySums(const TallySchema& schema)
      : schema_(schema), values_(schema.width()), accessed_(schema.width()) {}

  double& operator[](ScalarTally tally) { return (*this)[Tally(tally)][0]; }
  std::span<double> operator[](Tally tally) {
    if (tally.size > 0) accessed_[tally.first] = true;
    return std::span(values_).subspan(tally.first, tally.size);
  }

  /// Sets an array. Throws std::out_of_range, which names the tally, unless the sizes agree.
  void set(Tally tally, std::span<const double> values);

  /// Throws std::logic_error, which names the tally, if one has never been accessed: its mean would be 0.
  void require_filled() const;

  const std::vector<double>& values() const { return values_; }

 private:
  const TallySchema& schema_;
  std::vector<double> values_;
  std::vector<bool> accessed_;  // first columns of tallies and of their rows
};

/// Read-only view of the means over replicas of the tallies, or of the values of one replica.
class TallyMeans {
 public:
  // NOLINTBEGIN(cppcoreguidelines-explicit-constructor): any row of values can be viewed
  TallyMeans(std::span<const double> values) : values_(values) {}
  TallyMeans(const std::vector<double>& values) : values_(values) {}
  // NOLINTEND(cppcoreguidelines-explicit-constructor)

  double operator[](ScalarTally tally) const { return values_[tally.column]; }
  std::span<const double> operator[](Tally tally) const { return values_.subspan(tally.first, tally.size); }

 private:
  std::span<const double> values_;
};

/// Matrix of measurements: one row of sums per replica, in the order of the replicas.
class Records {
 public:
  /// expected: number of rows for which memory is reserved.
  explicit Records(std::size_t width, std::size_t expected = 0) : width_(width) {
    rows_.reserve(width * expected);
  }

  /// Throws std::invalid_argument if the row does not have the width of the others.
  void append(std::span<const double> row);

  std::size_t size() const { return rows_.size() / width_; }
  std::size_t width() const { return width_; }
  std::span<const double> operator[](std::size_t replica) const {
    return std::span(rows_).subspan(replica * width_, width_);
  }
  std::span<double> operator[](std::size_t replica) {
    return std::span(rows_).subspan(replica * width_, width_);
  }
  const std::vector<double>& values() const { return rows_; }  // row-major

  /// Mean over replicas; NaN without replicas.
  std::vector<double> mean() const;

 private:
  std::size_t width_;
  std::vector<double> rows_;
};

}  // namespace lorentz
