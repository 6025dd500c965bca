#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/observation.hpp"
#include "engine/open_dynamics.hpp"
#include "sampling/injection_controls.hpp"
#include "sampling/open_run.hpp"
#include "statistics/group.hpp"
#include "statistics/tally.hpp"
#include "statistics/time_integral.hpp"

namespace lorentz {

/// Differences that are 0 on average in a stationary state [eq. 46]: of the second half of the window minus
/// the first, and the energy that the chain gains. The particles that it gains tend to 0 as 1/t only, because
/// slow ones accumulate [eq. 24]; rates of crossings are too low by about this number.
struct HalfDifferenceTallies {
  Axis scatterer{"scatterer", "1", "First, middle, last", {0, 1, 2}};
  ScalarTally energy_current, particle_current, energy, particles;
  Tally temperature, injection;

  explicit HalfDifferenceTallies(TallySchema& schema)
      : energy_current(schema.tally("energy_current_difference", "energy/time",
                                    "Second half of the window minus first of J_U")),
        particle_current(schema.tally("particle_current_difference", "1/time",
                                      "Second half of the window minus first of J_n")),
        energy(schema.tally("energy_gain", "energy/time", "Energy that enters minus energy that leaves")),
        particles(schema.tally("particle_gain", "1/time", "Particles that enter minus those that leave")),
        temperature(schema.tally("temperature_difference", {scatterer}, "temperature",
                                 "Second half of the window minus first of <P^2>/M")),
        injection(schema.tally(
            "injection_difference", {InjectionControls::axis()}, "1",
            "Second half of the window minus first of the numbers, momenta and energies injected; mean 0")) {}

  Columns halves() const { return columns_of({energy_current, particle_current, temperature}); }
};

/// Tallies of every stationary state; an observable derives its own from them: control variates [eq. 30] and
/// those of the test.
struct StationaryTallies : TallySchema {
  Tally injection = tally("injection", {InjectionControls::axis()}, "1", "Injected, minus its known mean");
  HalfDifferenceTallies half_differences{*this};
};

/// Observer that fills StationaryTallies. Sums over the window are those over its halves, added.
class WindowHalves {
 public:
  WindowHalves(const OpenChain& chain, const Window& window)
      : chain_(chain),
        window_(window),
        halves_(window.begin, window.end, 2),
        scatterers_{0, chain.cells / 2, chain.cells - 1},
        squares_(scatterers_.size(), TimeIntegral(halves_)) {}

  [[gnu::always_inline]] void on_scatterer(std::uint32_t cell, double before, double time) {
    for (std::size_t i = 0; i < scatterers_.size(); ++i)
      if (cell == scatterers_[i]) squares_[i].advance(before * before, time);
  }

  void on_injection(End end, double time, double u) {
    injections_[halves_[time]].add(end, u);
    cross(time, u, 1);
  }

  void on_exit(End, double time, double u) {
    if (window_.contains(time)) cross(time, u, -1);
  }

  void finish(const std::vector<double>& scatterers, double end_time) {
    for (std::size_t i = 0; i < scatterers_.size(); ++i) {
      const double last = scatterers[scatterers_[i]];
      squares_[i].advance(last * last, end_time);
    }
  }

  double duration() const { return window_.end - window_.begin; }

  /// Over the window.
  OpeningCurrents openings() const { return openings_[0] + openings_[1]; }

  /// Time averages of U^2 of the first and the last scatterer over the window.
  std::array<double, 2> end_temperatures() const {
    const auto average = [&](const TimeIntegral& square) {
      return (square.sums()[0] + square.sums()[1]) / duration();
    };
    return {average(squares_.front()), average(squares_.back())};
  }

  void record(const StationaryTallies& tallies, TallySums& sums) const {
    sums.set(tallies.injection, (injections_[0] + injections_[1]).deviations(chain_, duration()));
    record(tallies.half_differences, sums);
  }

 private:
  void record(const HalfDifferenceTallies& tallies, TallySums& sums) const {
    const double half = halves_.length();
    sums[tallies.energy_current] = (openings_[1].energy - openings_[0].energy) / half;
    sums[tallies.particle_current] = (openings_[1].particles - openings_[0].particles) / half;
    sums[tallies.energy] = energy_gain_ / (2 * half);
    sums[tallies.particles] = particle_gain_ / (2 * half);
    for (std::size_t i = 0; i < scatterers_.size(); ++i)
      sums[tallies.temperature][i] = (squares_[i].sums()[1] - squares_[i].sums()[0]) / half;
    const auto first = injections_[0].deviations(chain_, half),
               second = injections_[1].deviations(chain_, half);
    for (std::size_t i = 0; i < first.size(); ++i) sums[tallies.injection][i] = second[i] - first[i];
  }

  /// sign: 1 for a particle that enters.
  void cross(double time, double u, double sign) {
    openings_[halves_[time]].cross(u);
    energy_gain_ += sign * 0.5 * u * u;
    particle_gain_ += sign;
  }

  OpenChain chain_;
  Window window_;
  Blocks halves_;
  std::array<std::uint32_t, 3> scatterers_;
  std::vector<TimeIntegral> squares_;  // of U
  std::array<OpeningCurrents, 2> openings_{};
  std::array<InjectionControls, 2> injections_;
  double energy_gain_ = 0, particle_gain_ = 0;
};

/// Quantities `stationarity_p_value`, `particle_gain`, as a share of the particles injected, and
/// `stationary`: 1 if the p-value exceeds 1e-4, so that the test rejects one stationary run in ten thousand
/// [eq. 47], and the gain, of either sign, does not exceed 4e-3, which goes with a bias of kappa of up to 3
/// %, by more than three of its standard errors; NaN if one of them is unknown, or this error above 4e-3,
/// with which the gain could not be seen.
Group stationarity(const HalfDifferenceTallies& tallies, const OpenChain& chain);

/// Line that restricts the meaning of results that are not stationary, with the remedy; none if they are.
std::vector<std::string> remarks_on_stationarity(const Results& results);

/// An observer of the stationary state, whose hooks are optional, and that of both halves of the window.
template <class Observer>
struct StationaryObserver {
  Observer observer;
  WindowHalves halves;

  [[gnu::always_inline]] void on_scatterer(std::uint32_t cell, double before, double time) {
    notify_scatterer(observer, cell, before, time);
    halves.on_scatterer(cell, before, time);
  }
  [[gnu::always_inline]] void on_flight(const Path& path) { notify_flight(observer, path); }
  void on_injection(End end, double time, double u) {
    if constexpr (requires { observer.on_injection(end, time, u); }) observer.on_injection(end, time, u);
    halves.on_injection(end, time, u);
  }
  void on_exit(End end, double time, double u) {
    if constexpr (requires { observer.on_exit(end, time, u); }) observer.on_exit(end, time, u);
    halves.on_exit(end, time, u);
  }
  void finish(const std::vector<double>& scatterers, double end_time) {
    if constexpr (requires { observer.finish(scatterers, end_time); }) observer.finish(scatterers, end_time);
    halves.finish(scatterers, end_time);
  }
  template <std::derived_from<StationaryTallies> Tallies>
  void record(const Tallies& tallies, TallySums& sums) const {
    if constexpr (requires { observer.record(tallies, halves, sums); })
      observer.record(tallies, halves, sums);
    else
      observer.record(tallies, sums);
    halves.record(tallies, sums);
  }
};

/// Study of a chain in its stationary state, as open_study(), with the test of stationarity. The observer has
/// record(tallies, sums), or record(tallies, const WindowHalves&, sums).
template <std::derived_from<StationaryTallies> Tallies, std::invocable MakeObserver>
Study stationary_study(const StationaryParameters& parameters, const Tallies& tallies,
                       const MakeObserver& make_observer, std::vector<Group> groups,
                       const std::string& target) {
  const Window window = parameters.window();
  groups.push_back(stationarity(tallies.half_differences, parameters.chain()));
  const auto make = [=] {
    return StationaryObserver{make_observer(), WindowHalves(parameters.chain(), window)};
  };
  Study study = open_study(parameters, window, tallies, make, std::move(groups), target);
  study.remarks = remarks_on_stationarity;
  return study;
}

}  // namespace lorentz
