#include "statistics/estimator.hpp"

#include <limits>
#include <stdexcept>

#include "statistics/jackknife.hpp"

namespace lorentz {
namespace {

/// Sets the error of an element that is 0 in every replica, such as an empty bin, to NaN: it is unknown.
void forget_errors_of_nothing(Quantity& quantity) {
  for (std::size_t i = 0; i < quantity.mean.size(); ++i)
    if (quantity.mean[i] == 0 && quantity.standard_error[i] == 0)
      quantity.standard_error[i] = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Results estimate(const Records& records, const std::vector<Description>& descriptions,
                 const std::function<std::vector<double>(RecordView)>& f) {
  const Estimate values = jackknife(records, [&](std::span<const double> mean) { return f(mean); });
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

}  // namespace lorentz
