#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "asdf_vk/run_control.h"

namespace asdfvk {
namespace {

constexpr const char* kLavapipeVariable = "LP_NUM_THREADS";  // Read when lavapipe creates a device.

}  // namespace

struct ThreadLimit::State {
  explicit State(uint32_t threadCount) : control(oneapi::tbb::global_control::max_allowed_parallelism, threadCount) {
    if (const char* value = std::getenv(kLavapipeVariable)) previous = value;
    setenv(kLavapipeVariable, std::to_string(threadCount).c_str(), 1);
  }
  ~State() {
    if (previous) {
      setenv(kLavapipeVariable, previous->c_str(), 1);
    } else {
      unsetenv(kLavapipeVariable);
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  oneapi::tbb::global_control control;
  std::optional<std::string> previous;
};

ThreadLimit::ThreadLimit(uint32_t threadCount)
    : state_(threadCount == 0 ? nullptr : std::make_unique<State>(threadCount)) {}
ThreadLimit::~ThreadLimit() = default;

}  // namespace asdfvk
