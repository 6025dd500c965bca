/// The event loop of an open chain that nobody observes: what the programs are measured against.
#include "observables/open_chain_options.hpp"
#include "program/replica_study.hpp"

namespace {

using namespace lorentz;

struct Nothing : NoObserver {
  std::vector<double> record() const { return {1}; }
};

}  // namespace

int main(int argc, char** argv) {
  Program program("bare_open_chain", "An open chain without an observer");
  OpenChainOptions options({.cell_length = 0}, "warm", {{{100}, {1000}}});
  options.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    options.validate();
    const auto measure = [&](const Replica& replica) {
      return options.measure(replica, {0, options.window().end}, Nothing());
    };
    const auto summarise = [](const Records& records) {
      return estimate(records, {{"replicas", "1", "1 of every replica"}},
                      [](std::span<const double> row) { return std::vector{row[0]}; });
    };
    return replicas.run({measure, summarise, "replicas", RandomStream::description}, progress);
  });
}
