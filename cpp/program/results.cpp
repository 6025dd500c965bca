#include "program/results.hpp"

#include <limits>
#include <stdexcept>

namespace lorentz {
namespace {

void describe(Hdf5Writer& file, const std::string& path, const std::string& units,
              const std::string& description) {
  file.attribute(path, "units", units);
  file.attribute(path, "description", description);
}

/// An element that is 0 in every replica, such as a bin that nothing fell into, has no error to be known.
void forget_errors_of_nothing(Quantity& quantity) {
  for (std::size_t i = 0; i < quantity.mean.size(); ++i)
    if (quantity.mean[i] == 0 && quantity.standard_error[i] == 0)
      quantity.standard_error[i] = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::size_t Description::size() const {
  std::size_t product = 1;
  for (const Axis& axis : axes) product *= axis.values.size();
  return product;
}

Results estimate(const Records& records, const std::vector<Description>& descriptions,
                 const RecordFunction& f) {
  const Estimate values = jackknife(records, f);
  Results results;
  auto mean = values.mean.begin(), error = values.standard_error.begin();
  for (const Description& what : descriptions) {
    const auto size = static_cast<std::ptrdiff_t>(what.size());
    if (values.mean.end() - mean < size) throw std::logic_error("fewer values than described");
    results.push_back({what,
                       {mean, mean + size},
                       {error, error + size},
                       std::vector<std::uint64_t>(what.size(), records.size())});
    if (!what.axes.empty()) forget_errors_of_nothing(results.back());
    mean += size;
    error += size;
  }
  if (mean != values.mean.end()) throw std::logic_error("more values than described");
  return results;
}

Results estimate(const ReducedRecords& records, const std::vector<Description>& descriptions,
                 const RecordFunction& f) {
  Results results = estimate(records.records, descriptions, f);
  for (Quantity& quantity : results) quantity.what.control_variates = records.control_variates;
  return results;
}

void write_results(Hdf5Writer& file, const Results& results) {
  for (const Quantity& quantity : results) {
    const std::string group = "/results/" + quantity.what.name + "/";
    Shape shape;
    for (const Axis& axis : quantity.what.axes) shape.push_back(axis.values.size());
    file.dataset(group + "mean", shape, quantity.mean);
    describe(file, group + "mean", quantity.what.units, quantity.what.description);
    if (quantity.what.control_variates)
      file.attribute(group + "mean", "control_variates", *quantity.what.control_variates);
    const auto write_error = [&](const std::string& name, const std::string& description) {
      file.dataset(group + name, shape, quantity.standard_error);
      describe(file, group + name, quantity.what.units, description);
    };
    if (quantity.count.empty()) {
      write_error("discretisation_error", "Difference from a coarser discretisation, and rounding");
    } else {
      write_error("standard_error", "Standard error of the mean over replicas");
      file.dataset(group + "count", shape, quantity.count);
      describe(file, group + "count", "1", "Number of replicas that contribute");
    }
    for (const Axis& axis : quantity.what.axes) {
      file.dataset(group + axis.name, {axis.values.size()}, axis.values);
      describe(file, group + axis.name, axis.units, axis.description);
    }
  }
}

}  // namespace lorentz
