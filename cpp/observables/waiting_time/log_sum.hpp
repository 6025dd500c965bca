#pragma once

namespace lorentz {

/// Sum of the logarithms of positive numbers, computed from products, so that few logarithms are evaluated.
class LogSum {
 public:
  void add(double number) {
    const double product = product_ * number;
    if (product > 0x1p-1000 && product < 0x1p1000) [[likely]] {
      product_ = product;
    } else {
      sum_ += std::log(product_) + std::log(number);
      product_ = 1;
    }
  }

  double sum() const { return sum_ + std::log(product_); }

 private:
  double product_ = 1;
  double sum_ = 0;  // of the numbers that are not in the product
};

}  // namespace lorentz
