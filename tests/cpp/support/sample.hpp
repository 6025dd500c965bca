#pragma once

#include <cmath>
#include <span>

namespace support {

/// A mean with its standard error.
struct Sample {
  double mean;
  double standard_error;
};

/// Mean and standard error of independent values.
inline Sample sample(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0;
  for (const double value : values) mean += value / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (count * (count - 1)))};
}

/// Difference of two independent means in units of its standard error.
inline double z_score(const Sample& a, const Sample& b) {
  return (a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

inline double z_score(const Sample& measured, double exact) {
  return (measured.mean - exact) / measured.standard_error;
}

}  // namespace support
