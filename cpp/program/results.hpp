#pragma once

#include "program/hdf5_file.hpp"
#include "statistics/quantity.hpp"

namespace lorentz {

/// Writes /results/NAME/{mean, standard_error, count} for a measured quantity, {mean, discretisation_error}
/// for a computed one, and the axes beside them as HDF5 dimension scales attached to the arrays.
void write_results(Hdf5Writer& file, const Results& results);

}  // namespace lorentz
