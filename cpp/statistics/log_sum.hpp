#pragma once

#include "model/portable.hpp"

namespace lorentz {

/// Sum of the logarithms of positive numbers: as the logarithm of their product, so that few are taken.
class LogSum {
 public:
  void add(double number) {
    const double product = product_ * number;
    if (product > 0x1p-1000 && product < 0x1p1000) [[likely]] {
      product_ = product;
    } else {
      sum_ += portable::log(product_) + portable::log(number);
      product_ = 1;
    }
  }

  double sum() const { return sum_ + portable::log(product_); }

 private:
  double product_ = 1;
  double sum_ = 0;  // without the product's
};

}  // namespace lorentz
