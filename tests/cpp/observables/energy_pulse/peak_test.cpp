#include "observables/energy_pulse/peak.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "numerics/random.hpp"
#include "support/sample.hpp"

namespace peak_test {

using namespace lorentz;

using Density = std::function<double(double)>;

/// A profile as a function of real distance, and its values at the cells.
struct Shape {
  std::string name;
  Density value;

  std::vector<double> cells() const {
    std::vector<double> result;
    for (int d = 0; d <= 50; ++d) result.push_back(value(d));
    return result;
  }

  /// Maximum between two distances, to 1e-6.
  Peak top(double from, double to) const {
    Peak best{from, value(from)};
    for (double step = 0.01; step > 1e-7; step /= 10) {
      for (double x = from; x <= to; x += step)
        if (value(x) > best.height) best = {x, value(x)};
      from = best.position - step;
      to = best.position + step;
    }
    return best;
  }
};

/// Rest of a pulse at its centre.
double centre(double x) { return 0.15 * std::exp(-0.5 * x * x); }

double mean_of_cell(const Density& density, double x) {
  double sum = 0;
  for (int i = 0; i < 100; ++i) sum += density(x - 0.495 + 0.01 * i) / 100;
  return sum;
}

Shape gaussian(double place, double width) {
  const auto density = [=](double x) {
    return std::exp(-0.5 * std::pow((x - place) / width, 2)) + centre(x);
  };
  return {"Gaussian", [=](double x) { return mean_of_cell(density, x); }};
}

/// Peak of the shape sech^2, which has longer tails than a Gaussian.
Shape soliton(double place, double width) {
  const auto density = [=](double x) {
    return std::pow(std::cosh((x - place) / (0.8 * width)), -2) + centre(x);
  };
  return {"sech^2", [=](double x) { return mean_of_cell(density, x); }};
}

/// Energy of freely flying particles that start in one cell with Gaussian momenta, minus that at a tenth of
/// the temperature. The density is proportional to x^2 exp(-x^2/(2 width^2)), width^2 = temperature t^2. It
/// is averaged over two cells: the positions of the start, and those of the measurement.
Shape free_flight(double width) {
  const auto one = [](double x, double s) { return x * x / (s * s * s) * std::exp(-0.5 * x * x / (s * s)); };
  const auto density = [=](double x) {
    return width * (one(x, width) - 0.1 * one(x, width * std::sqrt(0.1)));
  };
  return {"free flight",
          [=](double x) { return mean_of_cell([&](double y) { return mean_of_cell(density, y); }, x); }};
}

Peak measured(const Shape& shape) { return fit_peak(shape.cells(), *peak_window(shape.cells())); }

void expect_within(const Shape& shape, double width, double height_part, double position_part) {
  const double guess = measured(shape).position;
  const Peak exact = shape.top(guess - 1, guess + 1), found = measured(shape);
  EXPECT_LT(std::abs(found.height / exact.height - 1), height_part)
      << shape.name << ' ' << width << ' ' << guess;
  EXPECT_LT(std::abs(found.position - exact.position), position_part * width)
      << shape.name << ' ' << width << ' ' << guess;
}

// The biases, relative to the height and the width, are those stated in the documentation of fit_peak.
TEST(Peak, BiasIsWhatIsStated) {
  for (const double width : {1.0, 1.5, 2.5, 4.0, 7.0}) {
    for (const double shift : {0.0, 0.25, 0.5, 0.75}) {
      const double place = std::floor(std::max(6 * width, 5.0)) + shift;
      if (place > 30) continue;
      expect_within(gaussian(place, width), width, 0.001, 0.01);
      expect_within(soliton(place, width), width, width == 1 ? 0.05 : width == 1.5 ? 0.02 : 0.012, 0.05);
    }
  }
  for (const double width : {3.0, 4.0, 5.0, 7.0, 10.0}) expect_within(free_flight(width), width, 0.006, 0.02);
  expect_within(free_flight(2), 2, 0.03, 0.03);
}

/// Peaks of noisy profiles, each fitted in the window of the exact profile.
struct Noisy {
  std::vector<double> heights, positions, highest;
};

Noisy noisy_peaks(const Shape& shape, double noise) {
  const PeakWindow window = *peak_window(shape.cells());
  Noisy result;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    RandomStream random({seed, 1}, Purpose::initial_position, 0);
    std::vector<double> profile = shape.cells();
    for (double& value : profile) value += noise * random.gaussian();
    const Peak peak = fit_peak(profile, window);
    result.heights.push_back(peak.height);
    result.positions.push_back(peak.position);
    result.highest.push_back(*std::max_element(profile.begin() + 1, profile.end()));
  }
  return result;
}

double standard_deviation(const std::vector<double>& values) {
  return support::sample(values).standard_error * std::sqrt(static_cast<double>(values.size()));
}

// The mean over 1000 profiles with noise of a twentieth of the height differs from the noiseless fit only to
// second order in the noise; the raw maximum differs much more.
TEST(Peak, NoiseAddsNothingToFirstOrder) {
  const Shape shape = gaussian(20.3, 4);
  const Peak exact = measured(shape);
  const Noisy noisy = noisy_peaks(shape, 0.05);
  EXPECT_LT(std::abs(support::z_score(support::sample(noisy.positions), exact.position)), 4);
  const double quadratic = support::sample(noisy.heights).mean - exact.height;
  EXPECT_GT(quadratic, 0);
  EXPECT_LT(quadratic, 0.25 * standard_deviation(noisy.heights));
  EXPECT_GT(support::sample(noisy.highest).mean - exact.height, 4 * quadratic);
}

TEST(Peak, IsNoneWhereThereIsNone) {
  std::vector<double> falling, far_side, flat(51, 0.0), negative(51, -1.0), valley;
  for (int d = 0; d <= 50; ++d) {
    falling.push_back(std::exp(-0.1 * d));
    far_side.push_back(std::exp(-0.01 * std::pow(d - 47.0, 2)));
    valley.push_back(1 + std::pow(d - 20.0, 2));
  }
  for (const std::vector<double>& profile : {falling, far_side, flat, negative})
    EXPECT_FALSE(peak_window(profile).has_value());
  for (const std::vector<double>& profile : {falling, flat, negative, valley}) {
    EXPECT_TRUE(std::isnan(fit_peak(profile, {20, 6}).position));
    EXPECT_TRUE(std::isnan(fit_peak(profile, {20, 6}).height));
  }
  EXPECT_TRUE(std::isnan(fit_peak(std::vector<double>{0, 1, 0}, {1, 2.5}).height));
}

TEST(Profile, IsFoldedAndItsOddPartTaken) {
  EXPECT_EQ(folded(std::vector<double>{5, 4, 10, 6, 7}), (std::vector<double>{10, 5, 6}));
  EXPECT_EQ(odd_part(std::vector<double>{5, 4, 10, 6, 7}), (std::vector<double>{1, 1}));
  // The cell opposite to the centre is its own mirror image.
  EXPECT_EQ(folded(std::vector<double>{3, 4, 10, 6}), (std::vector<double>{10, 5, 3}));
  EXPECT_EQ(odd_part(std::vector<double>{3, 4, 10, 6}), (std::vector<double>{1}));
}

}  // namespace peak_test
