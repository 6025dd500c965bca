#include "program/interruption.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "program/errors.hpp"

namespace lorentz {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler reaches nothing else
std::atomic<int> received{0};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers may only access lock-free atomics");

extern "C" void note(int number) { received.store(number); }
extern "C" void end(int number) { ::_exit(static_cast<int>(ExitStatus::interrupted) + number); }

void handle_signals(void (*handler)(int)) {
  struct sigaction action{}, before{};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // a file that is being written is written to its end
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    sigaction(number, nullptr, &before);
    if (number != SIGHUP || before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
}

}  // namespace

void end_on_signals() { handle_signals(end); }
void note_signals() { handle_signals(note); }
int received_signal() { return received.load(std::memory_order_relaxed); }

}  // namespace lorentz
