/// Heat conductivity kappa(N) of an open chain, from the energy current J_U (positive to the right) and the
/// temperatures <P^2>/M of the first and the last scatterer:
///
///   kappa = -J_U N / (T_N - T_1).
///
/// The paper prints kappa = J_U/(T_N - T_1) for a chain of length 1; its exponents need the gradient per
/// cell, hence the factor N. Both are stored. Currents are means of those through the two openings.
///
/// What the reservoirs inject is the only randomness of the chain with gamma = N, and its mean is known:
/// numbers, momenta and energies of both serve as control variates (statistics/control_variates.hpp).
/// Quantities named
/// *_plain are those without. Stationarity is tested: the halves of the window have to agree, and not to be
/// correlated over replicas, as then the window would be short against the relaxation.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "observables/open_chain_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/time_integral.hpp"

namespace {

using namespace lorentz;

constexpr std::size_t halves = 2;

/// A cell at one end of the chain.
struct EndCell {
  std::uint32_t scatterer;
  std::int64_t mark;
  TimeIntegral scatterer_energy;             // of U^2
  double arrivals = 0, arriving_energy = 0;  // of the particles that come to the scatterer; sum of u^2

  EndCell(std::uint32_t cell, const Blocks& blocks)
      : scatterer(cell), mark(2 * std::int64_t{cell} + 1), scatterer_energy(blocks) {}
};

/// Everything that a replica has to see, by halves of the window.
class EndsAndOpenings {
 public:
  EndsAndOpenings(const OpenChain& chain, const Window& window)
      : blocks_(window.begin, window.end, halves),
        ends_{EndCell(0, blocks_), EndCell(chain.cells - 1, blocks_)} {}

  void on_collision(const Collision& collision) {
    for (EndCell& end : ends_)
      if (collision.scatterer == end.scatterer)
        end.scatterer_energy.hold(collision.scatterer_before * collision.scatterer_before, collision.time);
  }

  void on_flight(const Path& path) {
    for (EndCell& end : ends_) {
      if (!path.reaches(end.mark) || !blocks_.contain(path.time_at(end.mark))) continue;
      end.arrivals += 1;
      end.arriving_energy += path.velocity * path.velocity;
    }
  }

  void on_injection(End end, double time, double u) {
    if (!blocks_.contain(time)) return;
    controls_[blocks_[time]].add(end, u);
    cross_opening(time, u);
  }

  void on_exit(End, double time, double u) {
    if (blocks_.contain(time)) cross_opening(time, u);
  }

  void finish(const std::vector<double>& scatterers, double end_time) {
    for (EndCell& end : ends_) end.scatterer_energy.hold(std::pow(scatterers[end.scatterer], 2), end_time);
  }

  /// Of each half: J_U, J_n, T_1, T_N; then arrivals and their energy at both ends; then of each half the
  /// controls.
  std::vector<double> record(const OpenChain& chain) const {
    std::vector<double> values;
    for (std::size_t half = 0; half < halves; ++half) {
      for (const double sum : {energy_[half], particles_[half], ends_[0].scatterer_energy.sums()[half],
                               ends_[1].scatterer_energy.sums()[half]})
        values.push_back(sum / blocks_.length());
    }
    for (const EndCell& end : ends_) values.insert(values.end(), {end.arriving_energy, end.arrivals});
    for (const InjectionControls& controls : controls_) controls.append_to(values, chain, blocks_.length());
    return values;
  }

 private:
  /// The mean current of both openings: each crossing counts half.
  void cross_opening(double time, double u) {
    const std::size_t half = blocks_[time];
    energy_[half] += 0.25 * u * std::abs(u);
    particles_[half] += std::copysign(0.5, u);
  }

  Blocks blocks_;
  std::array<EndCell, 2> ends_;
  std::array<double, halves> energy_{}, particles_{};
  std::array<InjectionControls, halves> controls_;
};

/// Rows of both halves as one: means (sign 1) or differences, second minus first (sign -1), of the four
/// quantities; the arrivals; controls likewise.
Records joined(const Records& records, double sign) {
  constexpr std::size_t quantities = 4, arrivals = 4, first_control = halves * quantities + arrivals;
  Records result(quantities + arrivals + InjectionControls::count);
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    const std::span<const double> row = records[replica];
    std::vector<double> values;
    const auto join = [&](std::size_t first, std::size_t size, double scale) {
      for (std::size_t i = first; i < first + size; ++i)
        values.push_back(scale * (row[i + size] + sign * row[i]));
    };
    join(0, quantities, sign > 0 ? 0.5 : 1);
    const auto middle = row.subspan(halves * quantities, arrivals);
    values.insert(values.end(), middle.begin(), middle.end());
    join(first_control, InjectionControls::count, 1);
    result.append(values);
  }
  return result;
}

/// Difference of temperatures; NaN where there is none, as in a single cell.
double rise(double first, double last) {
  return first == last ? std::numeric_limits<double>::quiet_NaN() : last - first;
}

Results conductivity(const Records& joined_records, double cells, const std::string& suffix,
                     const std::string& remark) {
  return estimate(
      joined_records,
      {{"energy_current" + suffix, "energy/time", "J_U, positive to the right" + remark},
       {"particle_current" + suffix, "1/time", "J_n, positive to the right" + remark},
       {"temperature_first" + suffix, "k_B T", "<P^2>/M of the first scatterer" + remark},
       {"temperature_last" + suffix, "k_B T", "<P^2>/M of the last scatterer" + remark},
       {"kappa" + suffix, "1/time", "-J_U N / (T_N - T_1)" + remark},
       {"kappa_printed" + suffix, "1/time", "-J_U / (T_N - T_1), the paper's definition" + remark},
       {"kappa_particle" + suffix, "1/time", "-J_U N / difference of <p^2>/m of the arrivals" + remark}},
      [cells](std::span<const double> row) {
        const double per_degree = -row[0] / rise(row[2], row[3]);
        const double by_particles = -row[0] / rise(row[4] / row[5], row[6] / row[7]);
        return std::vector{
            row[0], row[1], row[2], row[3], per_degree * cells, per_degree, by_particles * cells};
      });
}

/// Correlation over replicas of J_U in the first half of the window with that in the second.
Results half_correlation(const Records& records) {
  const std::vector<double> mean = records.mean();
  constexpr std::size_t second = 4;  // column of J_U in the second half
  Records products(3);
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    const double a = records[replica][0] - mean[0], b = records[replica][second] - mean[second];
    products.append(std::array{a * a, b * b, a * b});
  }
  return estimate(
      products, {{"half_correlation", "1", "Correlation of J_U in both halves, over replicas"}},
      [](std::span<const double> row) { return std::vector{row[2] / std::sqrt(row[0] * row[1])}; });
}

/// Differences between the halves of the window, their correlation, and `stationary`: 1 if each of these is
/// below four standard errors, as they are in a stationary state that is watched for long.
Results stationarity(const Records& records) {
  Results results =
      estimate(reduce_variance(joined(records, -1), InjectionControls::count),
               {{"energy_current_drift", "energy/time", "J_U, second half of the window minus first"},
                {"temperature_first_drift", "k_B T", "T_1, second half minus first"},
                {"temperature_last_drift", "k_B T", "T_N, second half minus first"}},
               [](std::span<const double> row) { return std::vector{row[0], row[2], row[3]}; });
  for (Quantity& quantity : half_correlation(records)) results.push_back(std::move(quantity));
  const bool stationary = std::none_of(results.begin(), results.end(), [](const Quantity& quantity) {
    return std::abs(quantity.mean.front()) > 4 * quantity.standard_error.front();
  });
  results.push_back({{"stationary", "1", "1: halves of the window agree and are not correlated"},
                     {stationary ? 1. : 0.},
                     {std::numeric_limits<double>::quiet_NaN()},
                     {records.size()}});
  return results;
}

Results summarise(const Records& records, double cells) {
  const Records plain = joined(records, 1);
  Results results = conductivity(reduce_variance(plain, InjectionControls::count), cells, "", "");
  for (Results more :
       {conductivity(plain, cells, "_plain", ", without control variates"), stationarity(records)})
    results.insert(results.end(), more.begin(), more.end());
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("conductivity", "Heat conductivity of an open chain");
  const OpenChainOptions options(program.options(), {.cell_length = 0}, "warm", {{0.05, true}, {400}});
  const ReplicaOptions replicas(program);
  return program.run(argc, argv, [&](Progress& progress) {
    options.validate();
    const OpenChain chain = options.chain();
    const auto measure = [&](const Replica& replica) {
      EndsAndOpenings observer(chain, options.window());
      const std::uint64_t events = options.observe(replicas.seed(), replica, options.window().end, observer);
      return ReplicaRecord{observer.record(chain), events};
    };
    const auto results = [&](const Records& records) { return summarise(records, chain.cells); };
    const std::string target = chain.cells > 1 ? "kappa" : "energy_current";
    return replicas.run({measure, results, target, RandomStream::description}, progress);
  });
}
