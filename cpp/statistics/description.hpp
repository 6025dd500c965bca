#pragma once

#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace lorentz {

/// Coordinates along one dimension of an array.
struct Axis {
  std::string name;
  std::string units;
  std::string description;
  std::vector<double> values;
};

/// Axis of the integers first, first + 1, ...
inline Axis numbered_axis(const std::string& name, const std::string& description, std::size_t count,
                          double first = 0) {
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return {name, "1", description, numbers};
}

/// Name, units and shape of a tally or a quantity: a number, or a row-major array with one dimension per
/// axis.
struct Description {
  std::string name;
  std::string units;
  std::string description;
  std::vector<Axis> axes{};  // none for a number

  std::size_t size() const {
    std::size_t product = 1;
    for (const Axis& axis : axes) product *= axis.values.size();
    return product;
  }
};

}  // namespace lorentz
