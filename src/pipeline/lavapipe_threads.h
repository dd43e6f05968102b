#pragma once

#include <cstdlib>
#include <mutex>
#include <string>

#include "core/parallel.h"

namespace asdfvk {

/// While such objects exist, lavapipe creates devices with the number of threads that ThreadLimit allows for the first
/// of them, if this number is below the default. The first and the last object write the environment, which no other
/// thread should read meanwhile. A session creates and destroys them in the thread of its caller.
class LavapipeThreads {
 public:
  LavapipeThreads() {
    const std::scoped_lock lock(mutex());
    if (count()++ > 0) return;
    const size_t limit = threadLimit();
    isSet() = limit < defaultThreadCount() && std::getenv(kVariable) == nullptr;
    if (isSet()) setenv(kVariable, std::to_string(limit).c_str(), 1);
  }
  ~LavapipeThreads() {
    const std::scoped_lock lock(mutex());
    if (--count() == 0 && isSet()) unsetenv(kVariable);
  }
  LavapipeThreads(const LavapipeThreads&) = delete;
  LavapipeThreads& operator=(const LavapipeThreads&) = delete;

 private:
  static constexpr const char* kVariable = "LP_NUM_THREADS";

  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  static int& count() {
    static int instance = 0;
    return instance;
  }
  static bool& isSet() {
    static bool instance = false;
    return instance;
  }
};

}  // namespace asdfvk
