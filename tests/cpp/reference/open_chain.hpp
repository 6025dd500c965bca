#pragma once

#include <cstdint>

#include "reference/open_heap_simulator.hpp"

namespace reference {

/// Open chain by the reference simulator. Prints one line per replica with the results of the window after
/// the relaxation: per cell the temperature of the scatterer, <p^2> of the arrivals, the density, and the
/// arrivals to the right and to the left per unit time; per bond the particle current and the energy current;
/// per bond and bin the flux per unit momentum; then for the particles inside at the end of the window their
/// number and their number per bin.
struct OpenChain {
  OpenHeapParameters parameters;
  int replicas;
  std::uint64_t seed;

  void run() const {
    for (int replica = 0; replica < replicas; ++replica) {
      OpenHeapSimulator simulator(parameters, seed * 1000003 + static_cast<std::uint64_t>(replica));
      simulator.run(parameters.relaxation + parameters.observation);
      simulator.print();
    }
  }
};

}  // namespace reference
