#pragma once

#include <cstdint>
#include <vector>

namespace lorentz {

/// Numbers of particles; the one that was given back last is taken first.
class IdPool {
 public:
  std::uint32_t take() {
    if (free_.empty()) return count_++;
    const std::uint32_t number = free_.back();
    free_.pop_back();
    return number;
  }
  void give_back(std::uint32_t number) { free_.push_back(number); }

 private:
  std::uint32_t count_ = 0;
  std::vector<std::uint32_t> free_;
};

}  // namespace lorentz
