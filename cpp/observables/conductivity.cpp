/// Heat conductivity kappa(N) of an open chain, from the energy current J_U (positive to the right) and the
/// temperatures <P^2>/M of the first and the last scatterer:
///
///   kappa = -J_U N / (T_N - T_1).
///
/// The paper prints kappa = J_U/(T_N - T_1) for a chain of length 1; its exponents need the gradient per
/// cell, hence the factor N. Both are stored. Currents are means of those through the two openings.
///
/// What the reservoirs inject is the only randomness of the chain with gamma = N, and its mean is known:
/// numbers, momenta and energies of both serve as control variates (statistics/control_variates.hpp). With
/// gamma < N the two scatterers are hit by chance and seldom; what that adds to their energies is controlled
/// as well (observables/scattering_control.hpp). Quantities named *_plain are those without. Stationarity is
/// tested: the halves of the window have to agree (statistics/hotelling.hpp), and its blocks to be longer
/// than the correlations (statistics/blocking.hpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "observables/open_chain_options.hpp"
#include "observables/scattering_control.hpp"
#include "program/replica_study.hpp"
#include "statistics/blocking.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/hotelling.hpp"
#include "statistics/time_integral.hpp"

namespace {

using namespace lorentz;

constexpr std::size_t block_count = 8;  // of the window

/// A cell at one end of the chain.
struct EndCell {
  std::uint32_t scatterer;
  std::int64_t mark;
  TimeIntegral scatterer_energy;  // of U^2
  ScatteringControl chance;
  double arrivals = 0, arriving_energy = 0;  // of the particles that come to the scatterer; sum of u^2

  EndCell(std::uint32_t cell, const OpenChain& chain, const Blocks& blocks)
      : scatterer(cell), mark(2 * std::int64_t{cell} + 1), scatterer_energy(blocks), chance(chain, blocks) {}

  /// The scatterer has had this U up to a time.
  void hold(double momentum, double until) {
    scatterer_energy.hold(momentum * momentum, until);
    chance.hold(momentum, until);
  }
};

/// Everything that a replica has to see, by blocks of the window.
class EndsAndOpenings {
 public:
  EndsAndOpenings(const OpenChain& chain, const Window& window)
      : chain_(chain),
        blocks_(window.begin, window.end, block_count),
        ends_{EndCell(0, chain, blocks_), EndCell(chain.cells - 1, chain, blocks_)} {}

  void on_collision(const Collision& collision) {
    for (EndCell& end : ends_)
      if (collision.scatterer == end.scatterer) end.hold(collision.scatterer_before, collision.time);
  }

  void on_flight(const Path& path) {
    for (EndCell& end : ends_) {
      if (!path.reaches(end.mark)) continue;
      const double time = path.time_at(end.mark);
      if (!blocks_.contain(time)) continue;
      end.chance.expect(time, path.velocity, path.last == end.mark);
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
    for (EndCell& end : ends_) end.hold(scatterers[end.scatterer], end_time);
  }

  /// Of each block: J_U, J_n, T_1, T_N; then arrivals and their energy at both ends; then of each block the
  /// controls.
  std::vector<double> record() const {
    std::vector<double> values;
    for (std::size_t block = 0; block < block_count; ++block) {
      for (const double sum : {energy_[block], particles_[block], ends_[0].scatterer_energy.sums()[block],
                               ends_[1].scatterer_energy.sums()[block]})
        values.push_back(sum / blocks_.length());
    }
    for (const EndCell& end : ends_) values.insert(values.end(), {end.arriving_energy, end.arrivals});
    for (std::size_t block = 0; block < block_count; ++block) {
      controls_[block].append_to(values, chain_, blocks_.length());
      for (const EndCell& end : ends_) values.push_back(end.chance.sums()[block]);
    }
    return values;
  }

 private:
  /// The mean current of both openings: each crossing counts half.
  void cross_opening(double time, double u) {
    const std::size_t block = blocks_[time];
    energy_[block] += 0.25 * u * std::abs(u);
    particles_[block] += std::copysign(0.5, u);
  }

  OpenChain chain_;
  Blocks blocks_;
  std::array<EndCell, 2> ends_;
  std::array<double, block_count> energy_{}, particles_{};
  std::array<InjectionControls, block_count> controls_;
};

constexpr std::size_t quantities = 4, arrivals = 4;             // per block, and per replica
constexpr std::size_t controls = InjectionControls::count + 2;  // per block

/// Rows of all blocks as one: means over the window of the four quantities, or differences between its second
/// half and its first; the arrivals; the controls likewise.
Records joined(const Records& records, bool difference) {
  Records result(quantities + arrivals + controls);
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    const std::span<const double> row = records[replica];
    std::vector<double> values;
    const auto join = [&](std::size_t first, std::size_t size, double scale) {
      for (std::size_t i = 0; i < size; ++i) {
        double sum = 0;
        for (std::size_t block = 0; block < block_count; ++block)
          sum += (difference && block < block_count / 2 ? -1 : 1) * row[first + block * size + i];
        values.push_back(scale * sum);
      }
    };
    join(0, quantities, (difference ? 2. : 1.) / block_count);
    const auto middle = row.subspan(block_count * quantities, arrivals);
    values.insert(values.end(), middle.begin(), middle.end());
    join(block_count * quantities + arrivals, controls, 1);
    result.append(values);
  }
  return result;
}

/// Difference of temperatures; NaN where there is none, as in a single cell.
double rise(double first, double last) {
  return first == last ? std::numeric_limits<double>::quiet_NaN() : last - first;
}

template <class RecordsOrReduced>
Results conductivity(const RecordsOrReduced& joined_records, double cells, const std::string& suffix,
                     const std::string& remark) {
  return estimate(joined_records,
                  {{"energy_current" + suffix, "energy/time", "J_U, positive to the right" + remark},
                   {"particle_current" + suffix, "1/time", "J_n, positive to the right" + remark},
                   {"temperature_first" + suffix, "temperature", "<P^2>/M of the first scatterer" + remark},
                   {"temperature_last" + suffix, "temperature", "<P^2>/M of the last scatterer" + remark},
                   {"kappa" + suffix, "energy/(time temperature)", "-J_U N / (T_N - T_1)" + remark},
                   {"kappa_printed" + suffix, "energy/(time temperature)",
                    "-J_U / (T_N - T_1), the paper's definition" + remark},
                   {"kappa_particle" + suffix, "energy/(time temperature)",
                    "-J_U N / difference of <p^2>/m of the arrivals" + remark}},
                  [cells](std::span<const double> row) {
                    const double per_degree = -row[0] / rise(row[2], row[3]);
                    const double by_particles = -row[0] / rise(row[4] / row[5], row[6] / row[7]);
                    return std::vector{
                        row[0], row[1], row[2], row[3], per_degree * cells, per_degree, by_particles * cells};
                  });
}

/// J_U of every block.
Records current_by_blocks(const Records& records) {
  Records result(block_count);
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    std::vector<double> blocks;
    for (std::size_t block = 0; block < block_count; ++block)
      blocks.push_back(records[replica][block * quantities]);
    result.append(blocks);
  }
  return result;
}

/// A stationary chain is called drifting once in a hundred runs.
constexpr double level_of_drift = 0.01;

/// Differences between the halves of the window and the p-value of all of them being 0, the error of J_U by
/// blocks, and `stationary`: 1 if the p-value exceeds level_of_drift and the blocking has converged.
Results stationarity(const Records& records) {
  const ReducedRecords differences = reduce_variance(joined(records, true), controls);
  Results results = estimate(
      differences,
      {{"energy_current_drift", "energy/time", "J_U, second half of the window minus first"},
       {"particle_current_drift", "1/time", "J_n, second half minus first"},
       {"temperature_first_drift", "temperature", "T_1, second half minus first"},
       {"temperature_last_drift", "temperature", "T_N, second half minus first"}},
      [](std::span<const double> row) { return std::vector(row.begin(), row.begin() + quantities); });
  const double p_value =
      zero_mean_p_value(differences.records, quantities, differences.control_variates ? controls : 0);
  const Blocking blocks = blocking(current_by_blocks(records));
  const Axis length{"length", "1", "Part of the window that a block takes", {0.125, 0.25, 0.5, 1}};
  results.push_back({{"blocking_error", "energy/time", "Error of the plain J_U from blocks", {length}},
                     blocks.error,
                     blocks.uncertainty,
                     std::vector<std::uint64_t>(blocks.error.size(), records.size())});
  const auto test_result = [&](const std::string& name, const std::string& description, double value) {
    results.push_back(
        {{name, "1", description}, {value}, {std::numeric_limits<double>::quiet_NaN()}, {records.size()}});
  };
  test_result("drift_p_value", "p-value of the four drifts being 0, by Hotelling's T^2 test", p_value);
  test_result("stationary", "1: drift_p_value above 0.01, and blocking has converged",
              p_value > level_of_drift && blocks.converged() ? 1 : 0);
  return results;
}

Results summarise(const Records& records, double cells) {
  const Records plain = joined(records, false);
  Results results = conductivity(reduce_variance(plain, controls), cells, "", "");
  for (Results more :
       {conductivity(plain, cells, "_plain", ", without control variates"), stationarity(records)})
    results.insert(results.end(), more.begin(), more.end());
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("conductivity", "Heat conductivity of an open chain");
  OpenChainOptions options({.cell_length = 0}, "warm", {{{0.05, true}, {400}}});
  options.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    options.validate();
    const OpenChain chain = options.chain();
    const Window window = options.window();
    const auto measure = [&](const Replica& replica) {
      return options.measure(replica, window, EndsAndOpenings(chain, window));
    };
    const auto results = [&](const Records& records) { return summarise(records, chain.cells); };
    const std::string target = chain.cells > 1 ? "kappa" : "energy_current";
    return replicas.run({measure, results, target, RandomStream::description}, progress);
  });
}
