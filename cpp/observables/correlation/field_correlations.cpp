#include "observables/correlation/field_correlations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "model/collision.hpp"

namespace lorentz {
namespace {

/// The field minus its mean over the ring.
std::vector<double> fluctuation(std::vector<double> field) {
  const double total = std::accumulate(field.begin(), field.end(), 0.0);
  for (double& value : field) value -= total / static_cast<double>(field.size());
  return field;
}

}  // namespace

FieldCorrelations::FieldCorrelations(const ClosedParameters& parameters, const std::vector<std::size_t>& lags)
    : chain_(parameters.chain()), variances_(total_variances(parameters)) {
  for (std::size_t field = 0; field < variances_.size(); ++field)
    correlations_.emplace_back(chain_.cells, lags);
}

void FieldCorrelations::add(const PhasePoint& point) {
  ConservedFields fields = conserved_fields(point, chain_);
  for (std::size_t field = 0; field < fields.size(); ++field)
    correlations_[field].add(fluctuation(std::move(fields[field])));
}

std::vector<double> FieldCorrelations::profile(std::size_t field, std::size_t k) const {
  std::vector<double> profile = correlations_[field].at(k);
  const double cells = chain_.cells;
  for (double& value : profile) value += variances_[field] / (cells * cells);
  std::ranges::rotate(profile, profile.end() - static_cast<std::ptrdiff_t>(profile.size() / 2));
  return profile;
}

/// The shift to zero total momentum takes one degree of freedom from the particles and turns that of the
/// scatterers' total momentum into (1 + M/n).
std::array<double, 3> total_variances(const ClosedParameters& parameters) {
  const ClosedChain chain = parameters.chain();
  const double n = chain.particles_per_cell, cells = chain.cells;
  const double of_particle = 0.5 * std::pow(parameters.temperature, 2);
  const double of_scatterer = 0.5 * std::pow(parameters.scatterer_temperature, 2);
  double energies = cells * (n * of_particle + of_scatterer);
  if (parameters.zero_total_momentum) {
    const double mass = std::pow(CollisionRule(chain.sigma).root_mass(), 2);
    energies += of_scatterer * (std::pow(1 + mass / n, 2) - 1) - of_particle;
  }
  return {0, energies, parameters.mean_square_momentum()};
}

}  // namespace lorentz
