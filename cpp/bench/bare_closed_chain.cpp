/// The event loop of a closed chain without an observer, the baseline of the programs' cost.
#include "program/study.hpp"
#include "sampling/closed_run.hpp"

namespace {

using namespace lorentz;

struct Tallies : ClosedTallies {
  ScalarTally events = tally("events", "1", "Collisions");
};

Study bare_run(const ClosedParameters& parameters) {
  validate(parameters);
  const Tallies tallies;
  const auto observe = [=](ClosedRun& run, TallySums& sums) {
    NoObserver nobody;
    run.observe(nobody);
    sums[tallies.events] = static_cast<double>(run.chain().events());
  };
  Group group;
  group.quantity("events", "1", "Collisions of a replica",
                 [=](TallyMeans mean) { return mean[tallies.events]; });
  return closed_study(parameters, tallies, observe, {group}, "events");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("bare_closed_chain", "A closed chain without an observer");
  ClosedParameters parameters;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return bare_run(parameters); });
}
