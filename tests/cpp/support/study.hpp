#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "program/errors.hpp"
#include "program/hdf5_file.hpp"
#include "program/replica_study.hpp"
#include "program/results.hpp"

namespace support {

using namespace lorentz;
using Arguments = std::vector<std::string>;

/// A number that differs between replicas, with a standard deviation of about 0.3.
inline ReplicaRecord measure(const Replica& replica) {
  return {{1 + static_cast<double>((replica.key.replica * 7919 + 13) % 101) / 101}, 10};
}

inline Results summarise(const Records& records) {
  return estimate(records, {{"value", "1", "A number"}},
                  [](std::span<const double> mean) { return std::vector(mean.begin(), mean.end()); });
}

/// Runs a program of one study to its exit status.
inline int run_program(Arguments arguments, const Measurement& measurement) {
  arguments.insert(arguments.begin(), "example");
  if (std::ranges::find(arguments, "--progress") == arguments.end())
    arguments.insert(arguments.end(), {"--progress", "none"});
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  Program program("example", "An example");
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  const int status = program.run(static_cast<int>(pointers.size()), pointers.data(), [&](Progress& progress) {
    return replicas.run({measurement, summarise, "value", "none"}, progress);
  });
  for (const int number : {SIGINT, SIGTERM}) ::signal(number, SIG_DFL);  // the tests may be stopped again
  return status;
}

/// What the last run wrote to standard error.
inline std::string complaints;

inline int run(const Arguments& arguments, const Measurement& measurement = measure) {
  testing::internal::CaptureStderr();
  const int status = run_program(arguments, measurement);
  complaints = testing::internal::GetCapturedStderr();
  return status;
}

/// The measurement, stopped like by a signal at one replica.
inline Measurement interrupted_at(std::uint64_t index) {
  return [index](const Replica& replica) {
    if (replica.key.replica == index) throw Interrupted(SIGINT);
    return measure(replica);
  };
}

inline std::uint64_t replicas_in(const std::string& path) {
  return Hdf5Reader(path).counts("/results/value/count").at(0);
}

}  // namespace support
