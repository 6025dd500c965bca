#pragma once

#include <stdexcept>
#include <string>

namespace lorentz {

/// Exit statuses of every executable; interrupted ones follow the shell: 128 + signal.
enum class ExitStatus : int {
  done = 0,
  usage = 2,
  numerical_failure = 3,
  not_converged = 4,
  interrupted = 128,
};

/// The request cannot be carried out as it stands. The message says what, why and what to do.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A computation failed; no number can be vouched for.
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A signal asked the program to stop.
struct Interrupted : std::runtime_error {
  explicit Interrupted(int signal_number) : std::runtime_error("interrupted"), signal(signal_number) {}
  int signal;
};

}  // namespace lorentz
