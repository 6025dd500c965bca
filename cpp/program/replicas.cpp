#include "program/replicas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "program/errors.hpp"
#include "program/interruption.hpp"

namespace lorentz {
namespace {

/// State shared by the worker threads. The mutex protects everything except the atomic members.
class Team {
 public:
  Team(const ReplicaRun& run, const Measurement& measure, FinishedReplicas& finished)
      : run_(run), measure_(measure), finished_(finished), fractions_(run.threads) {
    for (std::uint64_t index = run.first; index < run.end; ++index)
      if (!finished.contains(index)) todo_.push_back(index);
    std::ranges::reverse(todo_);
  }

  void run() {
    {
      std::vector<std::jthread> workers;
      start(workers);
      if (workers.empty() && !todo_.empty()) {
        alone_ = true;  // written only where no thread is that could read it meanwhile
        work(fractions_[0]);
      }
      report_until_done();
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Starts as many threads as are needed and can be had.
  void start(std::vector<std::jthread>& workers) {
    const auto needed = std::min<std::size_t>(run_.threads, todo_.size());
    workers.reserve(needed);
    active_ = needed;
    try {
      while (workers.size() < needed)
        workers.emplace_back([this, worker = workers.size()] { work(fractions_[worker]); });
    } catch (const std::system_error& error) {
      const auto used = std::max<std::size_t>(workers.size(), 1);
      run_.warn(
          fmt::format("the run goes on with {} of {} threads: {}", used, needed, error.code().message()));
      const std::lock_guard lock(mutex_);
      active_ -= needed - used;
    }
  }

  /// Takes the index of the next replica. False if there is none, after a failure, and after the deadline
  /// except for the first two replicas.
  bool begin_next(std::uint64_t& index) {
    const std::lock_guard lock(mutex_);
    if (todo_.empty() || failure_) return false;
    index = todo_.back();
    if (index >= 2 && std::chrono::steady_clock::now() >= run_.deadline) return false;
    todo_.pop_back();
    return true;
  }

  /// Stores the first failure; every replica then stops at its next heartbeat. The caller holds the mutex.
  void fail(std::exception_ptr failure) {
    if (!failure_) failure_ = std::move(failure);
    failed_ = true;
  }

  void work(std::atomic<double>& fraction) {
    std::uint64_t index = 0;
    while (begin_next(index)) {
      const auto heartbeat = [this, &fraction](double part) {
        fraction.store(part, std::memory_order_relaxed);
        stop_after_signal();
        if (failed_.load(std::memory_order_relaxed)) throw Interrupted(0);
      };
      try {
        heartbeat(0);  // a short replica may not call it itself
        ReplicaRecord record = measure_({StreamKey(run_.seed, index), heartbeat});
        const std::lock_guard lock(mutex_);
        finished_.emplace(index, std::move(record));
        fraction.store(0, std::memory_order_relaxed);
        if (alone_) report();
      } catch (...) {
        const std::lock_guard lock(mutex_);
        fail(std::current_exception());
      }
    }
    const std::lock_guard lock(mutex_);
    --active_;
    changed_.notify_one();
  }

  /// The caller holds the mutex.
  void report() {
    auto done = static_cast<double>(finished_.size());
    for (const auto& fraction : fractions_) done += fraction.load(std::memory_order_relaxed);
    try {
      run_.report(done, finished_);
    } catch (...) {
      fail(std::current_exception());
    }
  }

  void report_until_done() {
    constexpr std::chrono::milliseconds interval(100);
    constexpr int longest_patience = 10;  // intervals
    int patience = 0;                     // intervals since a signal
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, interval, [this] { return active_ == 0; })) {
      report();
      if (const int signal = received_signal(); signal != 0 && ++patience > longest_patience)
        run_.abandon(signal, finished_);
    }
  }

  const ReplicaRun& run_;
  const Measurement& measure_;
  FinishedReplicas& finished_;
  std::vector<std::uint64_t> todo_;  // the next one last
  std::vector<std::atomic<double>> fractions_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t active_ = 0;
  bool alone_ = false;  // no thread could be started, so the calling one measures, and reports in between
  std::exception_ptr failure_;
  std::atomic<bool> failed_{false};
};

}  // namespace

void run_replicas(const ReplicaRun& run, const Measurement& measure, FinishedReplicas& finished) {
  Team(run, measure, finished).run();
}

}  // namespace lorentz
