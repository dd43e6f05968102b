#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

namespace asdfvk {

/// Exit code of a process that a signal cancelled: 128 + SIGINT.
inline constexpr int kCancelledCode = 130;

/// Handles SIGINT, SIGTERM and SIGHUP during its lifetime, except signals that were ignored before. The first signal
/// requests a stop of the computation, or ends the program if no Listening exists. A second signal ends the program if
/// it follows after more than 0.2 s, because a terminal or a wrapper may send a signal twice. A program that a signal
/// ends exits with kCancelledCode and leaves no half-written file. Precondition: no other Interrupt exists.
class Interrupt {
 public:
  /// isWorker: prints nothing, and ignores signals after the first one, because the main process ends workers.
  explicit Interrupt(bool isWorker = false);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  /// Exists while a computation polls token(). Several objects may exist.
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

/// Requests a stop after a time, or when another token requests a stop.
class Deadline {
 public:
  /// seconds: above 1e9 or infinite: no time limit. outer: the other token, for example Interrupt::token().
  Deadline(double seconds, const std::stop_token& outer);

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  /// Whether the time limit requested the stop.
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
