#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/errors.hpp"
#include "program/hdf5_file.hpp"
#include "program/study.hpp"

namespace support {

using namespace lorentz;
using Arguments = std::vector<std::string>;

using MeasureValue = std::function<double(const Replica&)>;

/// A number that differs between replicas, with a standard deviation of about 0.3.
inline double measure(const Replica& replica) {
  return 1 + static_cast<double>((replica.key.replica * 7919 + 13) % 101) / 101;
}

struct ValueTallies : TallySchema {
  ScalarTally value = tally("value", "1", "A number");
};

/// Study of one number per replica.
inline Study study_of(const MeasureValue& measurement) {
  const ValueTallies tallies;
  Group group;
  group.quantity("value", "1", "A number", [=](TallyMeans mean) { return mean[tallies.value]; });
  return {.tallies = tallies,
          .sample =
              [=](const Replica& replica, TallySums& sums) {
                sums[tallies.value] = measurement(replica);
                return 10;
              },
          .groups = {group},
          .target = "value"};
}

/// Study whose estimate begins with an action.
inline Study study_estimating(const std::function<void()>& action) {
  Study study = study_of(measure);
  study.groups.front().statistics({{"more", "1", "Another"}}, [=](const Records&) {
    action();
    return Estimate{{1}, {0}};
  });
  return study;
}

/// Runs a program of a study; returns its exit status.
inline int run_program(Arguments arguments, const std::function<Study()>& make) {
  arguments.insert(arguments.begin(), "example");
  if (std::ranges::find(arguments, "--progress") == arguments.end())
    arguments.insert(arguments.end(), {"--progress", "none"});
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  StudyProgram program("example", "An example");
  const int status = program.run(static_cast<int>(pointers.size()), pointers.data(), make);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) ::signal(number, SIG_DFL);  // as before
  return status;
}

/// Output of the last run on standard error.
inline std::string
    complaints;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): read after the call

inline int run(const Arguments& arguments, const std::function<Study()>& make) {
  testing::internal::CaptureStderr();
  const int status = run_program(arguments, make);
  complaints = testing::internal::GetCapturedStderr();
  return status;
}

inline int run(const Arguments& arguments, const MeasureValue& measurement = measure) {
  return run(arguments, [&] { return study_of(measurement); });
}

inline Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Measurement that must not be executed.
inline double never(const Replica&) { throw std::logic_error("measured"); }

/// The last run has printed one line with this part.
inline void expect_complaint(const std::string& part) {
  EXPECT_TRUE(complaints.starts_with("example: ")) << complaints;
  EXPECT_EQ(complaints.find('\n'), complaints.size() - 1) << complaints;
  EXPECT_NE(complaints.find(part), std::string::npos) << complaints;
}

/// The run is refused in one line with this part, and measures nothing.
inline void expect_refused_run(const Arguments& arguments, const std::string& part) {
  EXPECT_EQ(run(arguments, never), 2);
  expect_complaint(part);
}

/// Measurement that fails at one replica. The exit status is 3, and the finished replicas are kept.
inline MeasureValue failing_at(std::uint64_t index) {
  return [index](const Replica& replica) {
    if (replica.key.replica == index) throw NumericalError("a replica failed");
    return measure(replica);
  };
}

inline std::uint64_t replicas_in(const std::string& path) {
  return Hdf5Reader(path).counts("/results/value/count").at(0);
}

inline std::vector<std::uint64_t> replicas_kept(const std::string& path) {
  return Hdf5Reader(path + ".checkpoint").counts("/replicas/index");
}

}  // namespace support
