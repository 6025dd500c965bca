#include "observables/energy_pulse/moving_peak.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace moving_peak_test {

using namespace lorentz;

constexpr int cells = 121, centre = cells / 2;
const std::vector<double> times{1.1, 2.1, 4.3};
constexpr double positions[] = {20, 25, 36};  // at the speed 5
const double heights[] = {std::pow(1.1, -0.7), std::pow(2.1, -0.7), std::pow(4.3, -0.7)};

/// Gaussian peaks at equal distances on both sides, for which the fit of the logarithm is exact.
std::vector<double> profiles(double factor = 1) {
  std::vector<double> values;
  for (std::size_t k = 0; k < times.size(); ++k)
    for (int cell = 0; cell < cells; ++cell) {
      const double x = (std::abs(cell - centre) - positions[k]) / (2 * times[k]);
      values.push_back(factor * heights[k] * std::exp(-0.5 * x * x));
    }
  return values;
}

Records records_of(std::initializer_list<std::vector<double>> rows) {
  Records records(times.size() * cells);
  for (const std::vector<double>& row : rows) records.append(row);
  return records;
}

PeakWindows windows_of(const Records& records) {
  return peak_windows(records, Tally{0, records.width()}, times.size());
}

constexpr double total = 10;

/// Moving peak of a mean record that has the profiles only. The record must outlive it.
MovingPeak peak_of(const std::vector<double>& mean, const PeakWindows& windows) {
  return {mean, times, total, windows};
}

// The ends of the octaves are calculated by hand. Detected mistakes: octaves end at neighbouring times; an
// end occurs twice where times are sparse; a short octave remains at the end; t is divided into equal parts.
TEST(Octaves, DivideTheTimesEvenly) {
  using Times = std::vector<double>;
  EXPECT_EQ(octaves({0.016, 0.02, 0.025, 0.032, 0.04, 0.05, 0.063, 0.08, 0.1, 0.12}),
            (Times{0.016, 0.032, 0.063, 0.12}));
  EXPECT_EQ(octaves({0.01, 0.0125, 0.016, 0.02, 0.025, 0.032, 0.04}), (Times{0.01, 0.02, 0.04}));
  EXPECT_EQ(octaves({0.01, 0.0125, 0.016, 0.02, 0.025}), (Times{0.01, 0.025}));
  EXPECT_EQ(octaves({0.05, 0.1, 0.2, 0.4}), (Times{0.05, 0.1, 0.2, 0.4}));
  EXPECT_EQ(octaves({1e-4, 1, 1.1}), (Times{1e-4, 1, 1.1}));
  EXPECT_EQ(octaves({1, 1.1}), (Times{1, 1.1}));
  EXPECT_EQ(octaves({1}), (Times{1}));
}

// Detected mistake: the energy of the centre includes one side only.
TEST(MovingPeak, CentreHasTwoCellsOnBothSides) {
  const std::vector<double> mean = profiles();
  double sum = 0;
  for (int cell = centre - 2; cell <= centre + 2; ++cell) sum += mean[2 * cells + cell];
  EXPECT_NEAR(peak_of(mean, PeakWindows(times.size())).centre_shares()[2], sum / total, 1e-12);
}

// The peak has not left the centre at the first time. What depends on this time is NaN; all else uses the
// other times. Detected mistakes: the height is 0; the fit includes this time; all values are NaN; the two
// sides are not averaged; an exponent has the wrong sign.
TEST(MovingPeak, IsNaNBeforeThePeakHasLeftTheCentreAndThenFollowsGaussianPeaks) {
  std::vector<double> mean = profiles();
  for (int cell = 0; cell < cells; ++cell) mean[cell] = std::exp(-0.02 * (cell - centre) * (cell - centre));
  const PeakWindows windows = windows_of(records_of({mean, mean}));
  EXPECT_FALSE(windows[0]);
  ASSERT_TRUE(windows[1]);
  const MovingPeak peak = peak_of(mean, windows);
  EXPECT_TRUE(std::isnan(peak.positions()[0]));
  EXPECT_TRUE(std::isnan(peak.heights()[0]));
  EXPECT_TRUE(std::isnan(peak.speeds()[0]));
  EXPECT_TRUE(std::isnan(peak.exponents_from()[0]));
  EXPECT_TRUE(std::isnan(peak.exponents_by_octave()[0]));
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_NEAR(peak.positions()[k], positions[k], 1e-3) << k;
    EXPECT_NEAR(peak.heights()[k], heights[k], 1e-3) << k;
  }
  EXPECT_NEAR(peak.exponents_from()[1], 0.7, 1e-3);
  EXPECT_NEAR(peak.exponents_by_octave()[1], 0.7, 1e-3);
  EXPECT_NEAR(peak.speeds()[1], 5, 1e-3);
  EXPECT_NEAR(peak.exponent()[0], 0.7, 1e-3);
}

// Heights 1/t without a peak at the end of an octave. Detected mistakes: the octave is lost; a fit that
// covers less than half of the octave is kept.
TEST(MovingPeak, OctavesLeaveOutTimesWithoutAPeak) {
  const std::vector<double> uneven{1, 1.2, 1.5, 2, 2.1, 2.2, 4};
  std::vector<double> mean;
  for (const double time : uneven)
    for (int cell = 0; cell < cells; ++cell) {
      const double x = (std::abs(cell - centre) - 25) / 4.;
      mean.push_back(std::exp(-0.5 * x * x) / time);
    }
  const Records records = [&] {
    Records both(mean.size());
    for (int i = 0; i < 2; ++i) both.append(mean);
    return both;
  }();
  PeakWindows windows = peak_windows(records, Tally{0, records.width()}, uneven.size());
  windows[3] = windows[6] = std::nullopt;  // the ends of both octaves
  const std::vector<double> exponents = MovingPeak(mean, uneven, total, windows).exponents_by_octave();
  ASSERT_EQ(exponents.size(), 2U);
  EXPECT_NEAR(exponents[0], 1, 1e-3);
  EXPECT_TRUE(std::isnan(exponents[1]));
}

// The mean has a peak, but without the second replica the profile rises up to the far side, so that the
// jackknife gives no error. Detected mistake: only the mean determines the windows.
TEST(PeakWindows, HaveAPeakInEveryLeaveOneOutMean) {
  std::vector<double> none(times.size() * cells);
  for (std::size_t i = 0; i < none.size(); ++i)
    none[i] = 1e-3 * std::exp(0.02 * std::abs(static_cast<int>(i) % cells - centre));
  const PeakWindows windows = windows_of(records_of({none, profiles(3)}));
  for (const auto& window : windows) EXPECT_FALSE(window);
  for (const auto& window : windows_of(records_of({profiles(1), profiles(3)}))) EXPECT_TRUE(window);
  for (const auto& window : windows_of(records_of({profiles()}))) EXPECT_TRUE(window);
}

}  // namespace moving_peak_test
