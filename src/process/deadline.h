#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

namespace asdfvk {

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
