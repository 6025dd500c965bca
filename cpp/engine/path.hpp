#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/flight.hpp"

namespace lorentz {

/// A time interval [begin, end).
struct Window {
  double begin, end;
  bool contains(double time) const { return time >= begin && time < end; }
};

/// Index of a direction; axes of directions have this order.
enum Direction : std::size_t { leftwards, rightwards };  // NOLINT(cppcoreguidelines-use-enum-class): indices

/// Marks [low, high] of a Path; none if low > high.
struct Marks {
  std::int64_t low, high;
};

/// A flight in an open chain from a collision, an opening or the initial position to the next scattering or
/// the opening where the particle leaves. Positions are in half cells, as in OpenChain: the left opening is
/// 0, bond j is 2j, scatterer i is 2i + 1. A mark is an opening, a bond or a scatterer, at an integer
/// position.
struct Path {
  double departure, arrival;  // times since the start of the replica
  double velocity;            // u, energy-normalised; with m = 1 the momentum
  double from;                // position of the departure
  std::int64_t first, last;   // marks reached; the first mark of a particle that enters is the opening
  double time_per_half_cell;  // time for half a cell

  Direction direction() const { return lorentz::direction(velocity) > 0 ? Direction::rightwards : leftwards; }
  bool rightwards() const { return direction() == Direction::rightwards; }
  /// By arithmetic, as compilers turn minimum and maximum into a branch, which every second flight
  /// mispredicts.
  Marks marks() const {
    const std::int64_t ahead = last - first, back = ahead & (ahead >> 63);
    return {first + back, last - back};
  }
  bool reaches(std::int64_t mark) const { return (mark - first) * (mark - last) <= 0; }
  double time_at(std::int64_t mark) const {
    return departure + std::abs(static_cast<double>(mark) - from) * time_per_half_cell;
  }

  /// Number of marks reached before a time.
  std::int64_t marks_before(double time) const {
    const std::int64_t all = std::abs(last - first) + 1;
    if (time > arrival) return all;
    const double distance =
        (time - departure) / time_per_half_cell - std::abs(static_cast<double>(first) - from);
    return distance > 0 ? std::min(all, static_cast<std::int64_t>(std::ceil(distance))) : 0;
  }

  /// Position at a time of the flight.
  double position_at(double time) const {
    if (time >= arrival) return static_cast<double>(last);
    const double moved = (time - departure) / time_per_half_cell;
    return rightwards() ? from + moved : from - moved;
  }
};

/// For a path that may extend beyond the window.
[[gnu::cold]] inline Marks clipped_marks(const Path& path, const Window& window) {
  if (path.arrival < window.begin || path.departure >= window.end) return {1, 0};
  std::int64_t from = path.first, to = path.last;
  const std::int64_t step = path.rightwards() ? 1 : -1;
  if (path.departure < window.begin) from += step * path.marks_before(window.begin);
  if (path.arrival >= window.end) to = path.first + step * (path.marks_before(window.end) - 1);
  return path.rightwards() ? Marks{from, to} : Marks{to, from};
}

/// Marks that a path reaches in a window. Adjacent windows share none.
inline Marks marks_in(const Path& path, const Window& window) {
  if (path.departure >= window.begin && path.arrival < window.end) return path.marks();
  return clipped_marks(path, window);
}

/// The part of the chain that a path covers in a window, and its duration, 0 if there is none.
struct Stretch {
  double low, high;
  double duration;
};

inline Stretch stretch_in(const Path& path, const Window& window) {
  const double begin = std::max(path.departure, window.begin), end = std::min(path.arrival, window.end);
  if (!(begin < end)) return {0, 0, 0};
  const double a = path.position_at(begin), b = path.position_at(end);
  return {std::min(a, b), std::max(a, b), end - begin};
}

}  // namespace lorentz
