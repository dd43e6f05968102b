#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

namespace asdfvk {

/// Exit code of a process that a signal cancelled: 128 + SIGINT.
inline constexpr int kCancelledCode = 130;

/// Handles SIGINT, SIGTERM and SIGHUP, except those that were ignored, during its lifetime. The first signal requests a
/// stop of the computation, or ends the program if no Listening exists. The second one ends the program; one within
/// 0.2 s belongs to the first, which a terminal or a wrapper may send twice. The program then exits with
/// kCancelledCode and leaves no half-written file. One object at a time.
class Interrupt {
 public:
  /// isWorker: further signals are ignored, since the main process kills a worker that does not react, and nothing is
  /// printed.
  explicit Interrupt(bool isWorker = false);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  /// During its lifetime a computation polls token(). Several may exist.
  class Listening {
   public:
    Listening();
    ~Listening();
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
  };

 private:
  std::stop_source source_;
  std::jthread waiter_;
};

/// Requests a stop after a time, or when another token is stopped.
class Deadline {
 public:
  /// seconds: more than 1e9, also infinity, is no limit. outer: for example Interrupt::token().
  Deadline(double seconds, const std::stop_token& outer);

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  /// Whether the time, and not the other token, requested the stop.
  [[nodiscard]] bool hasExpired() const { return hasExpired_; }

 private:
  struct Forward {
    std::stop_source& source;
    void operator()() const noexcept { source.request_stop(); }
  };

  std::stop_source source_;
  std::stop_callback<Forward> forward_;
  std::atomic<bool> hasExpired_{false};
  std::mutex mutex_;
  std::condition_variable_any isEnding_;
  std::jthread waiter_;
};

}  // namespace asdfvk
