/// The event loop of an open chain without an observer, the baseline of the programs' cost.
#include "program/study.hpp"
#include "sampling/open_run.hpp"

namespace {

using namespace lorentz;

struct Tallies : TallySchema {
  ScalarTally events = tally("events", "1", "Collisions, injections and exits");
};

Study bare_run(const StationaryParameters& parameters) {
  validate(parameters);
  const Tallies tallies;
  const double end = parameters.window().end;
  const auto sample = [=](const Replica& replica, TallySums& sums) {
    OpenRun run(parameters, {0, end}, replica);
    NoObserver nobody;
    run.observe(nobody);
    sums[tallies.events] = static_cast<double>(run.events());
    return run.events();
  };
  Group group;
  group.quantity("events", "1", "Events of a replica", [=](TallyMeans mean) { return mean[tallies.events]; });
  return {.tallies = tallies, .sample = sample, .groups = {group}, .target = "events"};
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("bare_open_chain", "An open chain without an observer");
  StationaryParameters parameters;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return bare_run(parameters); });
}
