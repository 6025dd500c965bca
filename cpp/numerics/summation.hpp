#pragma once

#include <algorithm>
#include <cmath>

namespace lorentz {

/// Sum with about twice the precision of double: the rounding error of every addition is computed exactly
/// (Knuth's two-sum) and summed separately (Ogita, Rump & Oishi, SIAM J. Sci. Comput. 26, 1955 (2005)).
/// Unlike those of long double, its results are the same on every processor.
class CompensatedSum {
 public:
  void add(double x) {
    const double sum = sum_ + x, part = sum - sum_;
    errors_ += (sum_ - (sum - part)) + (x - part);
    sum_ = sum;
  }

  double value() const { return sum_ + errors_; }

  /// The sum without one of its terms; exactly 0 if the other terms are 0.
  double without(double x) const {
    CompensatedSum others = *this;
    others.add(-x);
    return others.value();
  }

 private:
  double sum_ = 0, errors_ = 0;
};

/// Power of two that scales a number to about 1, so that sums and squares neither overflow nor underflow.
inline double towards_one(double number) {
  return number > 0 ? std::ldexp(1.0, std::min(1000, -std::ilogb(number))) : 1;
}

}  // namespace lorentz
