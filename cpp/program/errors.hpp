#pragma once

#include <stdexcept>

namespace lorentz {

/// Exit statuses of every executable; interrupted ones follow the shell: 128 + signal.
enum class ExitStatus : int {
  done = 0,
  usage = 2,
  numerical_failure = 3,
  not_converged = 4,
  internal_error = 5,
  interrupted = 128,
};

/// Invalid input. The message states the problem, why it is one, and what to do.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A computation failed and has no valid result.
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lorentz
