#pragma once

namespace lorentz {

/// Handles SIGINT, SIGTERM, SIGHUP and SIGXCPU: end_on_signals() ends the process with the exit status
/// 128 + signal, note_signals() records the signal instead. SIGHUP remains ignored where it is, as by nohup.
void end_on_signals();
void note_signals();

/// Last signal recorded, or 0. Thread-safe and cheap: one atomic load.
int received_signal();

}  // namespace lorentz
