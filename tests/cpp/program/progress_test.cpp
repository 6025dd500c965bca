#include "program/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace progress_test {

using namespace lorentz;

TEST(Progress, WritesTheErrorInBrackets) {
  EXPECT_EQ(with_error(0.32080091, 0.0045), "0.3208(45)");
  EXPECT_EQ(with_error(-0.32080091, 0.00996), "-0.321(10)");
  EXPECT_EQ(with_error(12.3, 1.5), "12.3(1.5)");
  EXPECT_EQ(with_error(12.3, 0.999), "12.3(1.0)");
  EXPECT_EQ(with_error(41234.5, 1234), "41234(1200)");
  EXPECT_EQ(with_error(4.1234e-9, 1.2e-11), "4.123(12)e-9");
  EXPECT_EQ(with_error(0.5, 0), "0.5");
  EXPECT_EQ(with_error(0.5, std::nan("")), "0.5");
  EXPECT_EQ(with_error(-std::nan(""), 0.1), "nan");
}

}  // namespace progress_test
