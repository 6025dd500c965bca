/// Open chain by the reference simulator. Prints one line per replica with the results of the window after
/// the relaxation: per cell the temperature of the scatterer, <p^2> of the arrivals, the density, and the
/// arrivals to the right and to the left per unit time; per bond the particle current and the energy current;
/// per bond and bin the flux per unit momentum; then for the particles inside at the end of the window their
/// number and their number per bin.
///
///   reference_open_chain cells cell_length sigma gamma nu_left nu_right T_left T_right relaxation
///                        observation bins momentum_max replicas seed
#include <cstdlib>

#include "reference/open_heap_simulator.hpp"

int main(int argc, char** argv) {
  if (argc != 15) return 2;
  const auto number = [&](int i) { return std::atof(argv[i]); };
  const reference::OpenHeapParameters parameters{static_cast<std::size_t>(number(1)),
                                                 number(2),
                                                 number(3),
                                                 number(4),
                                                 number(5),
                                                 number(6),
                                                 number(7),
                                                 number(8),
                                                 number(9),
                                                 number(10),
                                                 static_cast<std::size_t>(number(11)),
                                                 number(12)};
  for (int replica = 0; replica < std::atoi(argv[13]); ++replica) {
    reference::OpenHeapSimulator simulator(
        parameters, static_cast<std::uint64_t>(std::atoll(argv[14]) * 1000003 + replica));
    simulator.run(parameters.relaxation + parameters.observation);
    simulator.print();
  }
}
