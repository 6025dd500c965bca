#pragma once

namespace lorentz {

/// Installs handlers that record SIGINT and SIGTERM instead of terminating the process.
void watch_for_signals();

/// Last signal received, or 0. Thread-safe and cheap: one atomic load.
int received_signal();

}  // namespace lorentz
