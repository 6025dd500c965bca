#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <queue>
#include <random>
#include <vector>

#include "reference/arguments.hpp"
#include "reference/rotation.hpp"

namespace reference {

/// Open chain by the reference simulator. Prints one line per replica with the results of the window after
/// the relaxation: per cell the temperature of the scatterer, <p^2> of the arrivals, the density, and the
/// arrivals to the right and to the left per unit time; per bond the particle current and the energy current;
/// per bond and bin the flux per unit momentum; then for the particles inside at the end of the window their
/// number and their number per bin.
struct OpenChain {
  Arguments of;
  std::size_t cells = of.count("cells"), bins = of.count("momentum-bins");
  double cell_length = of.number("cell-length"), sigma = of.number("sigma"), gamma = of.number("gamma"),
         nu_left = of.number("nu-left"), nu_right = of.number("nu-right"),
         T_left = of.number("temperature-left"), T_right = of.number("temperature-right"),
         relaxation = of.number("relaxation-time"), observation = of.number("observation-time"),
         rotation = of.number("rotation"),  // probability that a collision is followed by a rotation
      momentum_max = of.number("momentum-max");

  void run() const;
};

/// Independent reference implementation of the open chain: a binary heap, every crossing of a scatterer or a
/// bond an event, momenta (p, P) and masses as in the paper, empty start, direct counting. It shares no code
/// with the engine.
class OpenHeapSimulator {
 public:
  OpenHeapSimulator(const OpenChain& parameters, std::uint64_t seed)
      : parameters_(parameters), generator_(seed) {
    next_injection(true, 0);
    next_injection(false, 0);
  }

  /// Processes all events before `end`.
  void run(double end) {
    while (!events_.empty() && events_.top().time < end) {
      Event event = events_.top();
      events_.pop();
      if (event.injection) next_injection(event.p > 0, event.time);
      if (event.mark % 2 != 0)
        meet_scatterer(event);
      else if (!cross_bond(event))
        continue;
      event.injection = false;
      event.mark += event.p > 0 ? 1 : -1;
      event.time += parameters_.cell_length / 2 / std::abs(event.p);
      events_.push(event);
    }
    for (std::size_t cell = 0; cell < parameters_.cells; ++cell) advance(cell, end);
  }

  /// Prints the results at the end of the window.
  void print() {
    const double time = parameters_.observation;
    const double width = 2 * parameters_.momentum_max / static_cast<double>(parameters_.bins);
    for (const double value : scatterer_) write(value / time);
    for (std::size_t cell = 0; cell < parameters_.cells; ++cell)
      write(square_[cell] / (right_[cell] + left_[cell]));
    for (const double value : density_) write(value / time);
    for (const double value : right_) write(value / time);
    for (const double value : left_) write(value / time);
    for (const double value : particles_) write(value / time);
    for (const double value : energy_) write(value / time);
    for (const double value : flux_) write(value / time / width);
    double number = 0;
    std::vector<double> inside(parameters_.bins, 0);
    for (; !events_.empty(); events_.pop()) {
      if (events_.top().injection) continue;
      number += 1;
      const std::size_t bin = bin_of(events_.top().p);
      if (bin < inside.size()) inside[bin] += 1;
    }
    write(number);
    for (const double value : inside) write(value);
    std::printf("\n");
  }

 private:
  struct Event {
    double time, p;
    long mark;  // bond j at 2j, scatterer i at 2i + 1
    bool injection;
    bool operator<(const Event& other) const { return time > other.time; }  // the heap's top is the largest
  };

  static void write(double value) { std::printf("%.17g ", value); }

  void next_injection(bool left, double now) {
    const double rate = left ? parameters_.nu_left : parameters_.nu_right;
    const double T = left ? parameters_.T_left : parameters_.T_right;
    if (rate == 0) return;
    const double p = std::sqrt(T) * std::abs(std::normal_distribution<>()(generator_));
    const double time = now + std::exponential_distribution<>(rate)(generator_);
    events_.push({time, left ? p : -p, left ? 0 : 2 * static_cast<long>(parameters_.cells), true});
  }

  std::size_t bin_of(double p) const {
    const double place = (p / parameters_.momentum_max + 1) / 2 * static_cast<double>(parameters_.bins);
    return place >= 0 ? static_cast<std::size_t>(place) : parameters_.bins;
  }

  /// Processes the crossing of a bond; false if the particle leaves the chain.
  bool cross_bond(const Event& event) {
    const auto bond = static_cast<std::size_t>(event.mark / 2);
    if (event.time >= parameters_.relaxation) {
      particles_[bond] += event.p > 0 ? 1 : -1;
      energy_[bond] += (event.p > 0 ? 1 : -1) * event.p * event.p / 2;
      const std::size_t bin = bin_of(event.p);
      if (bin < parameters_.bins) flux_[bond * parameters_.bins + bin] += 1;
    }
    const bool into_left = event.p < 0;
    if (bond > 0) occupy(bond - 1, into_left ? 1 : -1, event.time);
    if (bond < parameters_.cells) occupy(bond, into_left ? -1 : 1, event.time);
    return !(bond == 0 && into_left) && !(bond == parameters_.cells && !into_left);
  }

  /// Processes the crossing of a scatterer.
  void meet_scatterer(Event& event) {
    const auto cell = static_cast<std::size_t>(event.mark / 2);
    if (event.time >= parameters_.relaxation) {
      square_[cell] += event.p * event.p;
      (event.p > 0 ? right_ : left_)[cell] += 1;
    }
    const double probability = parameters_.gamma / static_cast<double>(parameters_.cells);
    if (probability < 1 && std::uniform_real_distribution<>()(generator_) >= probability) return;
    advance(cell, event.time);
    const double sigma = parameters_.sigma, p = event.p;
    event.p = -sigma * p + (1 - sigma) * P_[cell];
    P_[cell] = (1 + sigma) * p + sigma * P_[cell];
    if (std::bernoulli_distribution(parameters_.rotation)(generator_)) {
      std::size_t other = std::bernoulli_distribution(0.5)(generator_) ? cell + 1 : cell - 1;
      if (cell == 0) other = 1;
      if (cell + 1 == parameters_.cells) other = cell - 1;
      advance(other, event.time);
      rotate(event.p, P_[cell], P_[other], (1 + sigma) / (1 - sigma), generator_);
    }
  }

  void occupy(std::size_t cell, int change, double time) {
    advance(cell, time);
    occupied_[cell] += change;
  }

  /// Advances the time integrals of a cell.
  void advance(std::size_t cell, double time) {
    if (time <= changed_[cell]) return;
    const double mass = (1 + parameters_.sigma) / (1 - parameters_.sigma);
    scatterer_[cell] += P_[cell] * P_[cell] / mass * (time - changed_[cell]);
    density_[cell] += occupied_[cell] * (time - changed_[cell]);
    changed_[cell] = time;
  }

  const OpenChain& parameters_;
  std::mt19937_64 generator_;
  std::priority_queue<Event> events_;
  using Values = std::vector<double>;
  const std::size_t cells_ = parameters_.cells, bonds_ = cells_ + 1;
  Values P_ = Values(cells_), changed_ = Values(cells_, parameters_.relaxation);
  std::vector<int> occupied_ = std::vector<int>(cells_);
  Values scatterer_ = Values(cells_), square_ = scatterer_, density_ = scatterer_, right_ = scatterer_,
         left_ = scatterer_, particles_ = Values(bonds_), energy_ = particles_,
         flux_ = Values(bonds_ * parameters_.bins);
};

inline void OpenChain::run() const {
  for (std::size_t replica = 0; replica < of.count("replicas"); ++replica) {
    OpenHeapSimulator simulator(*this, of.count("seed") * 1000003 + replica);
    simulator.run(relaxation + observation);
    simulator.print();
  }
}

}  // namespace reference
