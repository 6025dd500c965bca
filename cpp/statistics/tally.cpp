#include "statistics/tally.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace lorentz {

Axis numbered_axis(std::string_view name, std::string_view description, std::size_t count, double first) {
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return {std::string(name), "1", std::string(description), std::move(numbers)};
}

std::size_t Description::size() const {
  std::size_t product = 1;
  for (const Axis& axis : axes) product *= axis.values.size();
  return product;
}

Columns columns_of(std::initializer_list<Tally> tallies) {
  Columns columns;
  for (const Tally& tally : tallies)
    for (std::size_t i = 0; i < tally.size; ++i) columns.push_back(tally.first + i);
  return columns;
}

Tally TallySchema::tally(std::string_view name, const std::vector<Axis>& axes, std::string_view units,
                         std::string_view description) {
  tallies_.push_back({std::string(name), std::string(units), std::string(description), axes});
  const std::size_t size = tallies_.back().size(), steps = axes.empty() ? 1 : axes.front().values.size();
  return {std::exchange(width_, width_ + size), size, steps > 0 ? size / steps : 0};
}

ScalarTally TallySchema::tally(std::string_view name, std::string_view units, std::string_view description) {
  return {tally(name, {}, units, description).first};
}

const Description& TallySchema::description(Tally tally) const {
  std::size_t first = 0;
  for (const Description& what : tallies_) {
    if (first == tally.first && what.size() == tally.size) return what;
    first += what.size();
  }
  throw std::logic_error("a tally of another schema");
}

void TallySums::set(Tally tally, std::span<const double> values) {
  if (values.size() != tally.size)
    throw std::out_of_range("values of another size than the tally " + schema_.description(tally).name);
  std::ranges::copy(values, (*this)[tally].begin());
}

void TallySums::require_filled() const {
  auto begin = accessed_.begin();
  for (const Description& what : schema_.tallies()) {
    const auto end = begin + static_cast<std::ptrdiff_t>(what.size());
    if (begin != end && std::find(begin, end, true) == end)
      throw std::logic_error("the tally " + what.name + " is declared and never filled");
    begin = end;
  }
}

void Records::append(std::span<const double> row) {
  if (row.size() != width_) throw std::invalid_argument("a record of another width");
  rows_.insert(rows_.end(), row.begin(), row.end());
}

std::vector<double> Records::mean() const {
  if (size() == 0) return std::vector(width_, std::numeric_limits<double>::quiet_NaN());
  // Running means do not overflow. The mean deviation from them corrects their rounding errors.
  std::vector<double> result(width_, 0), deviation(width_, 0);
  for (std::size_t replica = 0; replica < size(); ++replica)
    for (std::size_t column = 0; column < width_; ++column)
      result[column] += ((*this)[replica][column] - result[column]) / static_cast<double>(replica + 1);
  for (std::size_t replica = 0; replica < size(); ++replica)
    for (std::size_t column = 0; column < width_; ++column)
      deviation[column] += (*this)[replica][column] - result[column];
  for (std::size_t column = 0; column < width_; ++column)
    result[column] += deviation[column] / static_cast<double>(size());
  return result;
}

}  // namespace lorentz
