#pragma once

#include "reference/arguments.hpp"
#include "reference/open_heap_simulator.hpp"

namespace reference {

/// Open chain by the reference simulator. Prints one line per replica with the results of the window after
/// the relaxation: per cell the temperature of the scatterer, <p^2> of the arrivals, the density, and the
/// arrivals to the right and to the left per unit time; per bond the particle current and the energy current;
/// per bond and bin the flux per unit momentum; then for the particles inside at the end of the window their
/// number and their number per bin.
inline void run_open_chain(const Arguments& of) {
  const OpenHeapParameters parameters{of.count("cells"),
                                      of.number("cell-length"),
                                      of.number("sigma"),
                                      of.number("gamma"),
                                      of.number("nu-left"),
                                      of.number("nu-right"),
                                      of.number("temperature-left"),
                                      of.number("temperature-right"),
                                      of.number("relaxation-time"),
                                      of.number("observation-time"),
                                      of.number("rotation"),
                                      of.count("momentum-bins"),
                                      of.number("momentum-max")};
  for (std::size_t replica = 0; replica < of.count("replicas"); ++replica) {
    OpenHeapSimulator simulator(parameters, of.count("seed") * 1000003 + replica);
    simulator.run(parameters.relaxation + parameters.observation);
    simulator.print();
  }
}

}  // namespace reference
