#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/flight.hpp"

namespace lorentz {

/// Unordered lists of flights in one array, in chunks of 256, so that appending and reading are sequential. A
/// list is a handle, the index after its last slot; 0 if it is empty.
class ChunkedLists {
 public:
  using List = std::uint32_t;

  /// Forgets all lists and makes room for so many flights, in huge pages, which cause fewer TLB misses.
  void reset(std::size_t flights, std::size_t lists) {
    flights_.clear();
    flights_.reserve(flights + flights / 4 + (lists + 16) * chunk);
#ifdef MADV_HUGEPAGE
    const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(flights_.data()) & ~std::uintptr_t{4095};
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the beginning of a page
    madvise(reinterpret_cast<void*>(begin), flights_.capacity() * sizeof(Flight), MADV_HUGEPAGE);
#endif
    next_.clear();
    previous_.clear();
    free_.clear();
  }

  const Flight& operator[](std::uint32_t slot) const { return flights_[slot]; }
  std::size_t slots() const { return flights_.size(); }

  /// All slots, until the next call of append().
  Flight* flights() { return flights_.data(); }
  std::uint32_t* links() { return next_.data(); }

  /// For links from slot to slot, whatever list they are in.
  std::uint32_t& next(std::uint32_t slot) { return next_[slot]; }
  std::uint32_t next(std::uint32_t slot) const { return next_[slot]; }

  /// Member by member: a block copy fails store-to-load forwarding from stores of single members.
  void write(std::uint32_t slot, const Flight& flight) {
    flights_[slot] = {flight.time, flight.velocity, flight.target, flight.particle, flight.draws};
  }

  /// Returns the slot, which stays the flight's until the list is cleared.
  std::uint32_t append(List& list, const Flight& flight) {
    const std::uint32_t slot = list % chunk != 0 ? list : begin_chunk(list);
    list = slot + 1;
    write(slot, flight);
    return slot;
  }

  void clear(List& list) {
    for (; list != 0; list = previous_[free_.back()]) free_.push_back((list - 1) / chunk);
  }

  /// Calls visit(slot) for every flight; it may append to other lists.
  template <class Visit>
  void for_each(List list, Visit&& visit) const {
    while (list != 0) {
      const std::uint32_t index = (list - 1) / chunk, rest = previous_[index];
      for (std::uint32_t slot = index * chunk; slot != list; ++slot) visit(slot);
      list = rest;
    }
  }

 private:
  static constexpr std::uint32_t chunk = 256;

  /// Returns the first slot of a new chunk. Out of line, so that the event loop needs fewer registers.
  [[gnu::noinline, gnu::cold]] std::uint32_t begin_chunk(List list) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(previous_.size()));
      previous_.push_back(0);
      flights_.resize(flights_.size() + chunk);
      next_.resize(flights_.size());
    }
    const std::uint32_t index = free_.back();
    free_.pop_back();
    previous_[index] = list;
    return index * chunk;
  }

  std::vector<Flight> flights_;
  std::vector<std::uint32_t> next_;
  std::vector<List> previous_;       // of a chunk: the list without it and those behind it
  std::vector<std::uint32_t> free_;  // chunks
};

}  // namespace lorentz
