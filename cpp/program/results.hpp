#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/hdf5_file.hpp"

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

/// A number with its error.
Quantity scalar(std::string name, std::string units, std::string description, double mean,
                double standard_error, std::uint64_t count);

using Results = std::vector<Quantity>;

/// Writes /results/<name>/{mean, standard_error, count} and the axes beside them.
void write_results(Hdf5Writer& file, const Results& results);

}  // namespace lorentz
