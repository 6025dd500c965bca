#include "observables/correlation/ring_correlation.hpp"

#include <stdexcept>
#include <utility>

namespace lorentz {

RingCorrelation::RingCorrelation(std::size_t cells, std::vector<std::size_t> lags)
    : cells_(cells),
      lags_(std::move(lags)),
      spectra_(lags_.size(), {std::vector<double>(cells / 2 + 1, 0)}),
      forward_(gsl_fft_real_wavetable_alloc(cells)),
      backward_(gsl_fft_halfcomplex_wavetable_alloc(cells)),
      workspace_(gsl_fft_real_workspace_alloc(cells)) {}

void RingCorrelation::add(std::vector<double> field) {
  gsl_fft_real_transform(field.data(), 1, cells_, forward_.get(), workspace_.get());
  transforms_.push_front(std::move(field));
  if (transforms_.size() > lags_.back() + 1) transforms_.pop_back();
  const std::vector<double>& now = transforms_.front();
  for (std::size_t k = 0; k < lags_.size() && lags_[k] < transforms_.size(); ++k) {
    const std::vector<double>& before = transforms_[lags_[k]];
    auto& [sum, count] = spectra_[k];
    // Half-complex order: the real part of wave number 0, then real and imaginary parts in turn.
    sum[0] += now[0] * before[0];
    for (std::size_t i = 1; i + 1 < cells_; i += 2)
      sum[(i + 1) / 2] += now[i] * before[i] + now[i + 1] * before[i + 1];
    if (cells_ % 2 == 0) sum[cells_ / 2] += now[cells_ - 1] * before[cells_ - 1];
    ++count;
  }
}

std::vector<double> RingCorrelation::at(std::size_t k) const {
  const auto& [sum, count] = spectra_[k];
  if (count == 0) throw std::logic_error("no snapshot is as late as the lag");
  std::vector<double> profile(cells_, 0);
  const double scale = 1 / (count * static_cast<double>(cells_));
  profile[0] = scale * sum[0];
  for (std::size_t i = 1; i < cells_; i += 2) profile[i] = scale * sum[(i + 1) / 2];
  gsl_fft_halfcomplex_inverse(profile.data(), 1, cells_, backward_.get(), workspace_.get());
  return profile;
}

}  // namespace lorentz
