#include "runs/peak_quantities.hpp"

#include <functional>

namespace lorentz {
namespace {

Axis middles(const std::vector<double>& times) {
  Axis axis{"middle", "time", "Middle of two neighbouring times", {}};
  for (std::size_t k = 0; k + 1 < times.size(); ++k) axis.values.push_back(0.5 * (times[k] + times[k + 1]));
  return axis;
}

}  // namespace

void add_peak_quantities(Formulas<MovingPeak>& formulas, const Axis& time, const std::string& units) {
  using std::mem_fn;
  const std::vector<double> ends = octaves(time.values);
  const Axis until{"until",
                   "time",
                   "Last time of an octave, which begins where the one before it ends",
                   {ends.begin() + 1, ends.end()}};
  const Axis from{"from", "time", "First time of the fit", {time.values.begin(), time.values.end() - 1}};
  formulas.quantity("peak_position", {time}, "1", "Distance of the moving peak from the centre, in cells",
                    mem_fn(&MovingPeak::positions));
  formulas.quantity("peak", {time}, units,
                    "Height of the moving peak, by a fit of exp(cubic) above half of it",
                    mem_fn(&MovingPeak::heights));
  formulas.quantity("peak_raw", {time}, units,
                    "Largest value of the folded profile, biased upwards by the noise",
                    mem_fn(&MovingPeak::raw_heights));
  formulas.quantity("peak_speed", {middles(time.values)}, "1/time",
                    "Cells per time by which peak_position moves between two times",
                    mem_fn(&MovingPeak::speeds));
  formulas.quantity("local_damping_exponent", {until}, "1",
                    "Minus the slope of ln peak against ln t over an octave",
                    mem_fn(&MovingPeak::exponents_by_octave));
  formulas.quantity("damping_drift", "1", "Slope of local_damping_exponent against ln t",
                    mem_fn(&MovingPeak::exponent_drift));
  formulas.quantity("damping_exponent_from", {from}, "1",
                    "Minus the slope of ln peak against ln t from a time on",
                    mem_fn(&MovingPeak::exponents_from));
  formulas.quantity("damping_exponent", "1", "The same over all times that have a peak",
                    mem_fn(&MovingPeak::exponent));
  formulas.quantity("peak_collapse", "1",
                    "Exponent xi that makes t^xi times the profile a function of (x - peak)/t^xi",
                    mem_fn(&MovingPeak::collapse));
}

}  // namespace lorentz
