#pragma once

namespace lorentz {

/// From now on SIGINT and SIGTERM are noted instead of ending the process at once.
void watch_for_signals();

/// The signal received, or 0. Safe to ask from any thread, and cheap.
int received_signal();

}  // namespace lorentz
