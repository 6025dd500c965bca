#include "observables/correlation/ring_correlation.hpp"

#include <algorithm>
#include <utility>

namespace lorentz {

RingCorrelation::RingCorrelation(std::size_t cells, std::vector<std::size_t> lags)
    : cells_(cells),
      lags_(std::move(lags)),
      spectra_(lags_.size(), {std::vector<double>(cells, 0)}),
      table_(cells),
      workspace_(cells) {}

std::vector<double> RingCorrelation::transform(std::vector<double> field) const {
  gsl_fft_real_transform(field.data(), 1, cells_, table_.get(), workspace_.get());
  return field;
}

void RingCorrelation::add(const std::vector<double>& field) {
  transforms_.push_front(transform(field));
  if (transforms_.size() > lags_.back() + 1) transforms_.pop_back();
  const std::vector<double>& now = transforms_.front();
  for (std::size_t k = 0; k < lags_.size() && lags_[k] < transforms_.size(); ++k) {
    const std::vector<double>& before = transforms_[lags_[k]];
    auto& [sum, count] = spectra_[k];
    for (std::size_t i = 0; i < cells_; ++i) sum[i] += now[i] * before[i];
    ++count;
  }
}

std::vector<double> RingCorrelation::at(std::size_t k) const {
  const auto& [sum, count] = spectra_[k];
  // Sum of the products of the real and of the imaginary parts at a wave number, of which 0 and, for an even
  // number of cells, the last one have no imaginary part. The spectrum is real and even, so its inverse
  // transform is its transform over the number of cells.
  const auto at_wave_number = [&](std::size_t q) {
    return q == 0 ? sum[0] : sum[2 * q - 1] + (2 * q < cells_ ? sum[2 * q] : 0);
  };
  std::vector<double> spectrum;
  for (std::size_t i = 0; i < cells_; ++i) spectrum.push_back(at_wave_number(std::min(i, cells_ - i)));
  const std::vector<double> real = transform(std::move(spectrum));
  const double scale = 1 / (count * static_cast<double>(cells_) * static_cast<double>(cells_));
  std::vector<double> profile;
  for (std::size_t r = 0; r < cells_; ++r) {
    const std::size_t q = std::min(r, cells_ - r);
    profile.push_back(scale * real[q == 0 ? 0 : 2 * q - 1]);
  }
  return profile;
}

}  // namespace lorentz
