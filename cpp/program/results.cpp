#include "program/results.hpp"

#include <utility>

namespace lorentz {
namespace {

void describe(Hdf5Writer& file, const std::string& path, const std::string& units,
              const std::string& description) {
  file.attribute(path, "units", units);
  file.attribute(path, "description", description);
}

}  // namespace

Quantity number(std::string name, std::string units, std::string description, const Estimate& estimate,
                std::size_t index, std::uint64_t count) {
  return array(std::move(name), std::move(units), std::move(description), estimate, index, count, {});
}

Quantity array(std::string name, std::string units, std::string description, const Estimate& estimate,
               std::size_t first, std::uint64_t count, std::vector<Axis> axes) {
  std::size_t size = 1;
  for (const Axis& axis : axes) size *= axis.values.size();
  const auto part = [&](const std::vector<double>& values) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(size));
  };
  return {std::move(name),
          std::move(units),
          std::move(description),
          part(estimate.mean),
          part(estimate.standard_error),
          std::vector<std::uint64_t>(size, count),
          std::move(axes)};
}

void write_results(Hdf5Writer& file, const Results& results) {
  for (const Quantity& quantity : results) {
    const std::string group = "/results/" + quantity.name + "/";
    Shape shape;
    for (const Axis& axis : quantity.axes) shape.push_back(axis.values.size());
    file.dataset(group + "mean", shape, quantity.mean);
    describe(file, group + "mean", quantity.units, quantity.description);
    file.dataset(group + "standard_error", shape, quantity.standard_error);
    describe(file, group + "standard_error", quantity.units, "Standard error of the mean over replicas");
    file.dataset(group + "count", shape, quantity.count);
    describe(file, group + "count", "1", "Number of replicas that contribute");
    for (const Axis& axis : quantity.axes) {
      file.dataset(group + axis.name, {axis.values.size()}, axis.values);
      describe(file, group + axis.name, axis.units, axis.description);
    }
  }
}

}  // namespace lorentz
