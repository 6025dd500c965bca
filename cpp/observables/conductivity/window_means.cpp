#include "observables/conductivity/window_means.hpp"

namespace lorentz {
namespace {

Records joined(const Records& records, bool difference) {
  const BlockTallies blocks, tallies(1);
  Records result(tallies.width());
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    const TallyMeans row = records[replica];
    TallySums window(tallies);
    const auto join = [&](Tally from, Tally to, double scale) {
      for (std::size_t i = 0; i < to.size; ++i) {
        double sum = 0;
        for (std::size_t block = 0; block < block_count; ++block)
          sum += (difference && block < block_count / 2 ? -1 : 1) * row[from.row(block)][i];
        window[to][i] = scale * sum;
      }
    };
    const double per_block = (difference ? 2. : 1.) / block_count;
    join(blocks.energy_current, tallies.energy_current, per_block);
    join(blocks.particle_current, tallies.particle_current, per_block);
    join(blocks.temperature, tallies.temperature, per_block);
    join(blocks.injection, tallies.injection, 1);
    join(blocks.scattering, tallies.scattering, 1);
    window.set(tallies.arriving_energy, row[blocks.arriving_energy]);
    window.set(tallies.arrivals, row[blocks.arrivals]);
    result.append(window.values());
  }
  return result;
}

}  // namespace

Records window_means(const Records& records) { return joined(records, false); }

Records half_differences(const Records& records) { return joined(records, true); }

}  // namespace lorentz
