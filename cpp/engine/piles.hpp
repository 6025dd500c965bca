#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/flight.hpp"
#include "engine/huge_pages.hpp"

namespace lorentz {

/// Piles of flights without order, in chunks of one memory. A flight is written behind the last one of its
/// pile, and a pile is read from one end to the other: in a large population, where each flight's memory is
/// fetched from afar, whole lines of the cache are used, and the next ones are asked for ahead.
class Piles {
 public:
  static constexpr std::uint32_t nowhere = 0;  // no place of a flight
  /// Flights between the one that is read and the one that is asked for.
  static constexpr std::ptrdiff_t ahead = 32;

  /// So many empty piles, with memory for so many flights; what there was is gone.
  void reset(std::size_t piles, std::size_t flights);

  const Flight& operator[](std::uint32_t place) const { return memory_[place]; }

  /// Member by member: copied in blocks, what has just been calculated would have to reach memory first.
  void write(std::uint32_t place, const Flight& flight) {
    Flight& to = memory_[place];
    to.time = flight.time;
    to.velocity = flight.velocity;
    to.target = flight.target;
    to.particle = flight.particle;
    to.draws = flight.draws;
  }

  /// All places are below.
  std::size_t places() const { return memory_.size(); }
  std::size_t size() const { return ends_.size(); }

  /// The place, which stays the flight's until its pile is cleared.
  std::uint32_t append(std::size_t pile, const Flight& flight) {
    std::uint32_t place = ends_[pile];
    if (place % chunk == 0) [[unlikely]]
      place = begin_chunk(place);
    ends_[pile] = place + 1;
    write(place, flight);
    __builtin_prefetch(&memory_[place] + line, 1);  // for the pile's next flight but one
    return place;
  }

  /// Everything in `from`, where nothing is left, becomes `to`, which was empty.
  void move(std::size_t from, std::size_t to) { ends_[to] = std::exchange(ends_[from], nowhere); }

  void clear(std::size_t pile);

  /// visit(place) for every flight; it may append to other piles.
  template <class Visit>
  void for_each(std::size_t pile, Visit&& visit) const {
    for (std::uint32_t end = ends_[pile]; end != nowhere;) {
      const std::uint32_t begin = chunk_of(end);
      const std::uint32_t previous = memory_[begin].target;
      for (std::uint32_t place = begin + 1; place != end; ++place) {
        __builtin_prefetch(&memory_[place] + ahead, 1);
        visit(place);
      }
      end = previous;
    }
  }

 private:
  static constexpr std::uint32_t chunk =
      256;                                   // flights; its first place links to the end of the chunk before
  static constexpr std::ptrdiff_t line = 2;  // flights in a line of the cache

  static std::uint32_t chunk_of(std::uint32_t end) { return (end - 1) / chunk * chunk; }
  std::uint32_t begin_chunk(std::uint32_t previous_end);

  std::vector<Flight, HugePageAllocator<Flight>> memory_;
  std::vector<std::uint32_t> ends_;  // one behind the last place, or nowhere
  std::vector<std::uint32_t> free_;  // chunks
};

}  // namespace lorentz
