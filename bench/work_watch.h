#pragma once

#include <ctime>

#include "core/stopwatch.h"

namespace asdfvk::bench {

/// Who does the work that is timed.
enum class Workers {
  Processors,  ///< Threads of this process: the seconds that all of them ran, which a busy machine disturbs less.
  Others,      ///< A GPU, say, or threads that wait for each other: the seconds that went by on the clock.
};

/// Seconds of work since it was made.
class WorkWatch {
 public:
  explicit WorkWatch(Workers workers) : workers_(workers) {}

  [[nodiscard]] double seconds() const {
    if (workers_ == Workers::Others) return watch_.seconds();
    return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC;
  }

 private:
  Workers workers_;
  std::clock_t begin_ = std::clock();
  Stopwatch watch_;
};

}  // namespace asdfvk::bench
