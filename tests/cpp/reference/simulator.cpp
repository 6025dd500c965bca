/// Independent simulators of the same observables, for the Python tests: they share no code and no
/// random numbers with the engine. Usage: reference_simulator NAME --option value ..., all options required.
#include "reference/arguments.hpp"
#include "reference/closed_chain.hpp"
#include "reference/open_chain.hpp"
#include "reference/pulse.hpp"

int main(int argc, char** argv) {
  using namespace reference;
  const std::string name = argc > 1 ? argv[1] : "";
  const Arguments arguments(argc, argv);
  if (name == "closed_chain") return ClosedChain{arguments}.run(), 0;
  if (name == "open_chain") return OpenChain{arguments}.run(), 0;
  if (name == "pulse") return Pulse{arguments}.run(), 0;
  std::fprintf(stderr, "no simulator is named '%s'\n", name.c_str());
  return 2;
}
