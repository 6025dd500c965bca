#include "engine/huge_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace {

using Allocator = lorentz::HugePageAllocator<double>;
using Array = std::vector<double, Allocator>;

TEST(HugePageAllocator, AlignsToPagesWhatFillsThem) {
  constexpr std::size_t per_page = Allocator::page / sizeof(double);
  for (const std::size_t count : {per_page, per_page + 1, 3 * per_page}) {
    const Array array(count, 1.0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % Allocator::page, 0U);
    EXPECT_EQ(array.back(), 1.0);
  }
}

TEST(HugePageAllocator, ServesSmallArraysAndGrowth) {
  Array array;
  for (int i = 0; i < 1'000'000; ++i) array.push_back(i);
  for (int i = 0; i < 1'000'000; ++i) ASSERT_EQ(array[static_cast<std::size_t>(i)], i);
}

}  // namespace
