#include "engine/piles.hpp"

namespace lorentz {

void Piles::reset(std::size_t piles, std::size_t flights) {
  memory_.clear();
  // Every pile's last chunk may be nearly empty; flights that move are in two places for a while.
  memory_.reserve(flights + flights / 4 + (piles + 16) * chunk);
  ends_.assign(piles, nowhere);
  free_.clear();
}

void Piles::clear(std::size_t pile) {
  for (std::uint32_t end = std::exchange(ends_[pile], nowhere); end != nowhere;) {
    const std::uint32_t begin = chunk_of(end);
    end = memory_[begin].target;
    free_.push_back(begin);
  }
}

/// First place of a new chunk.
std::uint32_t Piles::begin_chunk(std::uint32_t previous_end) {
  auto begin = static_cast<std::uint32_t>(memory_.size());
  if (free_.empty()) {
    memory_.resize(memory_.size() + chunk);
  } else {
    begin = free_.back();
    free_.pop_back();
  }
  memory_[begin].target = previous_end;
  return begin + 1;
}

}  // namespace lorentz
