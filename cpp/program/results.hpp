#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/hdf5_file.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/jackknife.hpp"

namespace lorentz {

/// Coordinates along one dimension of a quantity.
struct Axis {
  std::string name;
  std::string units;
  std::string description;
  std::vector<double> values;
};

/// What a quantity is: a number, or an array over its axes (row-major, one dimension per axis).
struct Description {
  std::string name;
  std::string units;
  std::string description;
  std::vector<Axis> axes{};                // none for a number
  std::optional<bool> control_variates{};  // whether they were used, where there are any

  std::size_t size() const;
};

/// A measured or computed quantity.
struct Quantity {
  Description what;
  std::vector<double> mean;
  std::vector<double> standard_error;  // NaN where undefined; of the discretisation if there is no count
  std::vector<std::uint64_t> count;    // replicas that contribute; none for what is computed, not measured
};

using Results = std::vector<Quantity>;

/// The quantities described, in their order, from the values that f makes of the mean record, in the same
/// order; errors by the jackknife over replicas, NaN for elements of arrays that are 0 in all of them. Throws
/// std::logic_error if f makes more values or fewer.
Results estimate(const Records& records, const std::vector<Description>& descriptions,
                 const RecordFunction& f);

/// The same from records with control variates; the quantities say whether these were used.
Results estimate(const ReducedRecords& records, const std::vector<Description>& descriptions,
                 const RecordFunction& f);

/// Writes /results/<name>/{mean, standard_error, count} and the axes beside them; {mean,
/// discretisation_error} if the quantity is computed.
void write_results(Hdf5Writer& file, const Results& results);

}  // namespace lorentz
