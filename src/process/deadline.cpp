#include "process/deadline.h"

#include <chrono>

namespace asdfvk {

Deadline::Deadline(double seconds, const std::stop_token& outer) : forward_(outer, Forward{source_}) {
  constexpr double kMaxSeconds = 1e9;  // More overflows the clock.
  if (!(seconds <= kMaxSeconds)) return;
  waiter_ = std::jthread([this, seconds](const std::stop_token& ending) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (isEnding_.wait_for(lock, ending, std::chrono::duration<double>(seconds), [] { return false; })) return;
    if (ending.stop_requested() || source_.stop_requested()) return;
    hasExpired_ = true;
    source_.request_stop();
  });
}

}  // namespace asdfvk
