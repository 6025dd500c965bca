#include "program/results.hpp"

namespace lorentz {
namespace {

/// The arrays of one quantity, with its axes attached.
class QuantityWriter {
 public:
  QuantityWriter(Hdf5Writer& file, const Description& what)
      : file_(file), what_(what), group_("/results/" + what.name + "/") {
    for (const Axis& axis : what.axes) {
      shape_.push_back(axis.values.size());
      file.dataset(group_ + axis.name, {axis.values.size()}, axis.values);
      describe(axis.name, axis.units, axis.description);
      file.make_scale(group_ + axis.name, axis.name);
    }
  }

  template <class Values>
  void array(const std::string& name, const Values& values, const std::string& units,
             const std::string& description) {
    file_.dataset(group_ + name, shape_, values);
    describe(name, units, description);
    for (std::size_t i = 0; i < what_.axes.size(); ++i)
      file_.attach_scale(group_ + name, i, group_ + what_.axes[i].name);
  }

  void attribute(const std::string& array, const std::string& name, bool value) {
    file_.attribute(group_ + array, name, value);
  }

 private:
  void describe(const std::string& array, const std::string& units, const std::string& description) {
    file_.attribute(group_ + array, "units", units);
    file_.attribute(group_ + array, "description", description);
  }

  Hdf5Writer& file_;
  const Description& what_;
  std::string group_;
  Shape shape_;
};

}  // namespace

void write_results(Hdf5Writer& file, const Results& results) {
  for (const Quantity& quantity : results) {
    const std::string& units = quantity.what.units;
    QuantityWriter writer(file, quantity.what);
    writer.array("mean", quantity.mean, units, quantity.what.description);
    if (quantity.control_variates) writer.attribute("mean", "control_variates", *quantity.control_variates);
    if (quantity.count.empty()) {
      writer.array("discretisation_error", quantity.standard_error, units,
                   "Difference from a coarser discretisation, and rounding");
    } else {
      writer.array("standard_error", quantity.standard_error, units,
                   "Standard error of the mean over replicas");
      writer.array("count", quantity.count, "1", "Number of replicas that contribute");
    }
  }
}

}  // namespace lorentz
