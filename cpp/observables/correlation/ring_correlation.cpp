#include "observables/correlation/ring_correlation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace lorentz {

RingCorrelation::RingCorrelation(std::size_t cells, std::vector<std::size_t> lags)
    : cells_(cells),
      lags_(std::move(lags)),
      spectra_(lags_.size(), {std::vector<double>(cells / 2 + 1, 0)}),
      transform_(cells) {}

void RingCorrelation::add(const std::vector<double>& field) {
  transforms_.push_front(transform_(field));
  if (transforms_.size() > lags_.back() + 1) transforms_.pop_back();
  const std::vector<std::complex<double>>& now = transforms_.front();
  for (std::size_t k = 0; k < lags_.size() && lags_[k] < transforms_.size(); ++k) {
    const std::vector<std::complex<double>>& before = transforms_[lags_[k]];
    auto& [sum, count] = spectra_[k];
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += now[i].real() * before[i].real() + now[i].imag() * before[i].imag();
    ++count;
  }
}

std::vector<double> RingCorrelation::at(std::size_t k) const {
  const auto& [sum, count] = spectra_[k];
  if (count == 0) throw std::logic_error("no snapshot is as late as the lag");
  // The spectrum is real and even, so its inverse transform is its transform over the number of cells.
  std::vector<double> spectrum;
  for (std::size_t i = 0; i < cells_; ++i) spectrum.push_back(sum[std::min(i, cells_ - i)]);
  const std::vector<std::complex<double>> transform = transform_(spectrum);
  const double scale = 1 / (count * static_cast<double>(cells_) * static_cast<double>(cells_));
  std::vector<double> profile;
  for (std::size_t r = 0; r < cells_; ++r)
    profile.push_back(scale * transform[std::min(r, cells_ - r)].real());
  return profile;
}

}  // namespace lorentz
