#pragma once

namespace lorentz {

/// Installs handlers that record SIGINT, SIGTERM, SIGHUP and SIGXCPU instead of terminating the process.
/// SIGHUP stays ignored where it is, as by nohup.
void watch_for_signals();

/// Last signal received, or 0. Thread-safe and cheap: one atomic load.
int received_signal();

/// Throws Interrupted after a signal. As cheap.
void stop_after_signal();

/// While one exists, the process ends a second after a signal if it still runs, whatever it is doing: for a
/// computation that has nothing to save.
class NothingToSave {
 public:
  NothingToSave();
  NothingToSave(const NothingToSave&) = delete;
  NothingToSave& operator=(const NothingToSave&) = delete;
  ~NothingToSave();
};

}  // namespace lorentz
