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

Quantity scalar(std::string name, std::string units, std::string description, double mean,
                double standard_error, std::uint64_t count) {
  return {std::move(name), std::move(units), std::move(description), {mean}, {standard_error}, {count}, {}};
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
