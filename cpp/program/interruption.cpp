#include "program/interruption.hpp"

#include <signal.h>

#include <atomic>

namespace lorentz {
namespace {

std::atomic<int> received{0};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers may only access lock-free atomics");

extern "C" void note_signal(int number) { received.store(number); }

}  // namespace

void watch_for_signals() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int received_signal() { return received.load(std::memory_order_relaxed); }

}  // namespace lorentz
