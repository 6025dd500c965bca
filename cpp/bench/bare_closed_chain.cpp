/// The event loop of a closed chain that nobody observes: what the programs are measured against.
#include "observables/closed_chain_options.hpp"
#include "program/replica_study.hpp"

int main(int argc, char** argv) {
  using namespace lorentz;
  Program program("bare_closed_chain", "A closed chain without an observer");
  ClosedChainOptions chain;
  chain.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    chain.validate();
    const auto measure = [&](const Replica& replica) {
      ClosedReplica run(chain, replica);
      NoObserver nobody;
      run.observe_until(chain.end_time(), nobody);
      return run.record({static_cast<double>(run.chain().events())});
    };
    const auto summarise = [](const Records& records) {
      return estimate(records, {{"events", "1", "Collisions of a replica"}},
                      [](std::span<const double> row) { return std::vector{row[0]}; });
    };
    return replicas.run({measure, with_drift(summarise), "events", RandomStream::description}, progress);
  });
}
