#include "program/interruption.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "program/errors.hpp"

namespace lorentz {
namespace {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): a signal handler reaches nothing else
std::atomic<int> received{0};
std::atomic<bool> nothing_to_save{false};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "signal handlers may only access lock-free atomics");

extern "C" void note_signal(int number) {
  received.store(number);
  if (nothing_to_save.load()) ::alarm(1);
}

extern "C" void end_process(int) { ::_exit(static_cast<int>(ExitStatus::interrupted) + received.load()); }

void handle(int number, void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // a file that is being saved is saved to its end
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

}  // namespace

void watch_for_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction before{};
    sigaction(number, nullptr, &before);
    if (number != SIGHUP || before.sa_handler != SIG_IGN) handle(number, note_signal);
  }
  handle(SIGALRM, end_process);
}

int received_signal() { return received.load(std::memory_order_relaxed); }

void stop_after_signal() {
  if (const int signal = received_signal()) throw Interrupted(signal);
}

NothingToSave::NothingToSave() { nothing_to_save.store(true); }

NothingToSave::~NothingToSave() {
  nothing_to_save.store(false);
  ::alarm(0);
}

}  // namespace lorentz
