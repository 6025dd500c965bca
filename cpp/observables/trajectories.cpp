/// World lines of the particles of a short chain: every flight in a window of time, of one replica. A closed
/// chain is a ring; an open chain is a row between two reservoirs.
///
/// A flight is straight, from one scattering to the next. Those in progress at the beginning or the end of
/// the window are cut there. On a ring of length L a flight starts in [0, L) and may end outside.
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "numerics/random.hpp"
#include "program/program.hpp"
#include "sampling/closed_run.hpp"
#include "sampling/open_run.hpp"

namespace {

using namespace lorentz;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Parameters : ClosedParameters {
  std::string kind = "closed", start = "empty";
  Reservoir left{0.7, 4}, right{1.4, 1};
  std::uint64_t seed = 1;

  Parameters() {
    ring = {.scattering = {.cells = 8}, .particles_per_cell = 2};
    temperature = scatterer_temperature = 1;
    relaxation_time = 10;
    observation_time = 8;
  }
  Window window() const { return {relaxation_time, end_time()}; }
  OpenParameters open() const {
    return {.scattering = ring.scattering,
            .cell_length = ring.cell_length,
            .left = left,
            .right = right,
            .start = start};
  }
};

/// From one event of a particle to the next, or its part in the window.
struct Segment {
  double particle;
  double start_time, end_time;  // infinite for a particle at rest
  double start_position, end_position;
  double momentum;                  // u; m = 1
  double scatterer_momentum = nan;  // U of the scatterer at the start, after the collision
};

struct Column {
  std::string name, units, description;
  double Segment::* value;
};

const std::vector<Column> columns{
    {"particle", "1", "Number of the particle, from 0", &Segment::particle},
    {"start_time", "time", "Beginning of the flight, from the beginning of the window", &Segment::start_time},
    {"end_time", "time", "End of the flight", &Segment::end_time},
    {"start_position", "length", "Where the flight begins", &Segment::start_position},
    {"end_position", "length", "Where it ends; on a ring it may be outside", &Segment::end_position},
    {"momentum", "momentum", "p of the particle during the flight", &Segment::momentum},
    {"scatterer_momentum", "momentum",
     "P/sqrt(M) of the scatterer at the start after the collision; nan if the flight starts elsewhere",
     &Segment::scatterer_momentum}};

/// Flights in a window, in the order of their beginning.
class Flights {
 public:
  explicit Flights(Window window) : window_(window) {}

  /// Throws UsageError if there are too many.
  void add(Segment segment) {
    constexpr std::size_t most = 100'000;
    if (all_.size() == most)
      throw UsageError(
          "--observation-time: there are more than 100000 flights, too many to plot. Choose a shorter time, "
          "or fewer cells or particles.");
    const Segment whole = segment;
    const auto cut = [&](double time) {
      return whole.start_position + whole.momentum * (time - whole.start_time);
    };
    if (whole.start_time < window_.begin) {
      segment.start_position = cut(segment.start_time = window_.begin);
      segment.scatterer_momentum = nan;
    }
    if (whole.end_time > window_.end) segment.end_position = cut(segment.end_time = window_.end);
    segment.start_time -= window_.begin;
    segment.end_time -= window_.begin;
    all_.push_back(segment);
  }

  Results results() const {
    const Axis flight = numbered_axis("flight", "Number of the flight, by its beginning", all_.size());
    Results results;
    for (const auto& [name, units, description, value] : columns) {
      Quantity& quantity = results.emplace_back(Quantity{{name, units, description, {flight}}, {}, {}});
      for (const Segment& each : all_) quantity.mean.push_back(each.*value);
      quantity.standard_error.assign(all_.size(), nan);
      quantity.count.assign(all_.size(), 1);
    }
    return results;
  }

 private:
  Window window_;
  std::vector<Segment> all_;
};

/// Observer of a ring, whose clock may restart.
class RingObserver {
 public:
  /// The run must be at the beginning of the window.
  RingObserver(const ClosedRun& run, const Parameters& parameters, Flights& flights)
      : run_(run), length_(parameters.ring.cell_length), flights_(flights) {
    const double begin = parameters.window().begin, now = run.clock(begin);
    const std::vector<Particle> particles = run.chain().phase_point(now).particles;
    const std::vector<double> from_target = run.chain().positions_from_targets(now);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const auto& [position, u, draws] = particles[i];
      flights.add({static_cast<double>(i), begin, begin + std::abs(from_target[i] / u), position,
                   position - from_target[i], u});
    }
  }

  void on_collision(const Collision& collision) { last_ = collision; }

  void on_flight(const Departure& flight) {
    const double time = flight.time - run_.clock(0), position = (last_.scatterer + 0.5) * length_;
    flights_.add({static_cast<double>(flight.particle), time, time + flight.duration, position,
                  position + static_cast<double>(flight.cells) * length_, flight.velocity,
                  last_.scatterer_after});
  }

 private:
  const ClosedRun& run_;
  double length_;
  Flights& flights_;
  Collision last_{};
};

/// Observer of a row between reservoirs, where a Path has no number: the particle of a flight is that of the
/// flight whose end is the collision before, or else a new one.
class RowObserver {
 public:
  RowObserver(const Parameters& parameters, Flights& flights)
      : half_cell_(parameters.ring.cell_length / 2), flights_(flights) {}

  void on_collision(const Collision& collision) { last_ = collision; }

  void on_flight(const Path& path) {
    const double particle = last_ ? arriving(*last_) : newest_++;
    flights_.add({particle, path.departure, path.arrival, half_cell_ * path.from,
                  half_cell_ * static_cast<double>(path.last), path.velocity,
                  last_ ? last_->scatterer_after : nan});
    under_way_.emplace(Arrival(path.arrival, path.last, path.velocity), particle);
    last_.reset();
  }

 private:
  using Arrival = std::tuple<double, std::int64_t, double>;  // time, mark, velocity

  double arriving(const Collision& collision) {
    const std::int64_t mark = 2 * std::int64_t{collision.scatterer} + 1;
    return under_way_.extract(Arrival(collision.time, mark, collision.particle_before)).mapped();
  }

  double half_cell_;
  Flights& flights_;
  std::multimap<Arrival, double> under_way_;  // particles
  double newest_ = 0;
  std::optional<Collision> last_;
};

std::uint64_t observe_ring(const Parameters& parameters, const Replica& replica, Flights& flights) {
  ClosedRun run(parameters, replica);
  run.relax();
  RingObserver observer(run, parameters, flights);
  run.observe(observer);
  return run.chain().events();
}

std::uint64_t observe_row(const Parameters& parameters, const Replica& replica, Flights& flights) {
  OpenRun run(parameters.open(), parameters.window(), replica);
  RowObserver observer(parameters, flights);
  run.observe(observer);
  return run.events();
}

Outcome observe(const Parameters& parameters) {
  const Replica replica{StreamKey(parameters.seed, 0), [](double) {}};
  Flights flights(parameters.window());
  const std::uint64_t events =
      (parameters.kind == "open" ? observe_row : observe_ring)(parameters, replica, flights);
  return {.results = flights.results(),
          .seed = parameters.seed,
          .streams = RandomStream::description,
          .events = events,
          .target_quantity = "none",
          .target_error = nan,
          .achieved_error = nan,
          .convergence = Convergence::no_target};
}

std::vector<Description> quantities(const Parameters& parameters) {
  if (parameters.kind == "open")
    validate(parameters.open(), parameters.end_time(), "--relaxation-time plus --observation-time");
  else
    validate(parameters);
  std::vector<Description> all;
  for (const Quantity& each : Flights(parameters.window()).results()) all.push_back(each.what);
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("trajectories", "World lines of the particles of a short chain");
  Parameters parameters;
  Options& options = program.options();
  options.choice("--chain", parameters.kind, {"closed", "open"},
                 "closed: a ring with --particles-per-cell, at the --temperature; open: between reservoirs");
  declare(options, parameters);
  declare(options, parameters.left, parameters.right);
  options.choice(
      "--start", parameters.start, {"empty", "warm"},
      "Of an open chain. empty: no particles, scatterers at rest; warm: near the stationary state");
  options.integer("--seed", parameters.seed, {}, "Key of all random streams");
  return program.run(
      argc, argv, [&] { return quantities(parameters); }, [&] { return program.write(observe(parameters)); });
}
