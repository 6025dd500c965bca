/// Independent simulators of the same observables, for the Python tests and workflow/tradeoff: they share no
/// code and no random numbers with the engine. One subcommand each, all options required.
#include <CLI/CLI.hpp>
#include <memory>

#include "reference/closed_chain.hpp"
#include "reference/correlation.hpp"
#include "reference/drift.hpp"
#include "reference/open_chain.hpp"
#include "reference/pulse.hpp"

namespace {

/// Subcommand whose options are those of a simulator, and which executes its run().
template <class Simulator>
class Command {
 public:
  Command(CLI::App& app, const char* name, const char* help)
      : command_(*app.add_subcommand(name, help)), simulator_(std::make_shared<Simulator>()) {
    command_.callback([simulator = simulator_] { simulator->run(); });
  }

  template <class Value>
  CLI::Option* add(const char* name, Value& value) {
    return command_.add_option(name, value)->required();
  }

  Simulator* operator->() { return simulator_.get(); }

 private:
  CLI::App& command_;
  std::shared_ptr<Simulator> simulator_;
};

void add_closed_chain(CLI::App& app) {
  Command<reference::ClosedChain> chain(app, "closed_chain", "Displacements, energies and waiting times");
  chain.add("--cells", chain->cells);
  chain.add("--particles-per-cell", chain->particles_per_cell);
  chain.add("--sigma", chain->sigma);
  chain.add("--gamma", chain->gamma);
  chain.add("--temperature", chain->temperature);
  chain.add("--relaxation-time", chain->relaxation);
  chain.add("--observation-time", chain->observation);
  chain.add("--rule", chain->rule)->check(CLI::IsMember({"elastic", "random-direction"}));
  chain.add("--first-edge", chain->first_edge);
  chain.add("--bins-per-decade", chain->bins_per_decade);
  chain.add("--bins", chain->bins);
  chain.add("--times", chain->times)->delimiter(',');
  chain.add("--replicas", chain->replicas);
  chain.add("--seed", chain->seed);
}

void add_open_chain(CLI::App& app) {
  Command<reference::OpenChain> chain(app, "open_chain", "Profiles, currents and fluxes");
  reference::OpenHeapParameters& parameters = chain->parameters;
  chain.add("--cells", parameters.cells);
  chain.add("--cell-length", parameters.cell_length);
  chain.add("--sigma", parameters.sigma);
  chain.add("--gamma", parameters.gamma);
  chain.add("--nu-left", parameters.nu_left);
  chain.add("--nu-right", parameters.nu_right);
  chain.add("--temperature-left", parameters.T_left);
  chain.add("--temperature-right", parameters.T_right);
  chain.add("--relaxation-time", parameters.relaxation);
  chain.add("--observation-time", parameters.observation);
  chain.add("--momentum-bins", parameters.bins);
  chain.add("--momentum-max", parameters.momentum_max);
  chain.add("--replicas", chain->replicas);
  chain.add("--seed", chain->seed);
}

void add_pulse(CLI::App& app) {
  Command<reference::Pulse> pulse(app, "pulse", "Energy with a pulse minus without");
  pulse.add("--cells", pulse->cells);
  pulse.add("--particles-per-cell", pulse->particles_per_cell);
  pulse.add("--sigma", pulse->sigma);
  pulse.add("--gamma", pulse->gamma);
  pulse.add("--energy", pulse->energy);
  pulse.add("--pulse-energy", pulse->pulse_energy);
  pulse.add("--pairs-per-replica", pulse->pairs);
  pulse.add("--start", pulse->start)->check(CLI::IsMember({"shared", "independent"}));
  pulse.add("--times", pulse->times)->delimiter(',');
  pulse.add("--replicas", pulse->replicas);
  pulse.add("--seed", pulse->seed);
}

void add_correlation(CLI::App& app) {
  Command<reference::Correlation> chain(app, "correlation", "Correlations of cells in equilibrium");
  chain.add("--cells", chain->cells);
  chain.add("--fugacity", chain->zeta);
  chain.add("--sigma", chain->sigma);
  chain.add("--temperature", chain->temperature);
  chain.add("--slowest", chain->slowest);
  chain.add("--lag", chain->lag);
  chain.add("--replicas", chain->replicas);
  chain.add("--seed", chain->seed);
}

void add_drift(CLI::App& app) {
  Command<reference::Drift> chain(app, "drift", "Energy drift by floating-point type");
  chain.add("--cells", chain->cells);
  chain.add("--particles-per-cell", chain->particles_per_cell);
  chain.add("--sigma", chain->sigma);
  chain.add("--temperature", chain->temperature);
  chain.add("--observation-time", chain->time);
  chain.add("--seed", chain->seed);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Reference simulators"};
  app.require_subcommand(1);
  add_closed_chain(app);
  add_open_chain(app);
  add_pulse(app);
  add_correlation(app);
  add_drift(app);
  CLI11_PARSE(app, argc, argv);
}
