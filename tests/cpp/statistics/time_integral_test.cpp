#include "statistics/time_integral.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace time_integral_test {

using namespace lorentz;

TEST(TimeIntegral, DividesAmongBlocks) {
  TimeIntegral integral(Blocks(10, 14, 4));
  integral.advance(5, 3);      // ends before the window
  integral.advance(2, 10.5);   // counts from 10 on
  integral.advance(4, 12.25);  // extends over three blocks
  integral.advance(1, 99);     // ends after the window
  EXPECT_EQ(integral.sums(), (std::vector<double>{3, 4, 1.75, 1}));
}

}  // namespace time_integral_test
