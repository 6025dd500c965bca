#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/hdf5_file.hpp"
#include "statistics/jackknife.hpp"

namespace lorentz {

/// Coordinates along one dimension of a quantity.
struct Axis {
  std::string name;
  std::string units;
  std::string description;
  std::vector<double> values;
};

/// A measured quantity: a number, or an array over its axes (row-major, one dimension per axis).
struct Quantity {
  std::string name;
  std::string units;
  std::string description;
  std::vector<double> mean;
  std::vector<double> standard_error;  // NaN where undefined
  std::vector<std::uint64_t> count;    // replicas that contribute
  std::vector<Axis> axes;              // none for a number
};

/// The number at `index` of an estimate.
Quantity number(std::string name, std::string units, std::string description, const Estimate& estimate,
                std::size_t index, std::uint64_t count);

/// The numbers from `first` on, as many as the axes span.
Quantity array(std::string name, std::string units, std::string description, const Estimate& estimate,
               std::size_t first, std::uint64_t count, std::vector<Axis> axes);

using Results = std::vector<Quantity>;

/// Writes /results/<name>/{mean, standard_error, count} and the axes beside them.
void write_results(Hdf5Writer& file, const Results& results);

}  // namespace lorentz
