#include <oneapi/tbb/global_control.h>

#include "asdf_vk/run_control.h"

namespace asdfvk {

struct ThreadLimit::State {
  oneapi::tbb::global_control control;
};

ThreadLimit::ThreadLimit(uint32_t threadCount) {
  if (threadCount == 0) return;
  using oneapi::tbb::global_control;
  state_.reset(new State{global_control(global_control::max_allowed_parallelism, threadCount)});
}
ThreadLimit::~ThreadLimit() = default;

}  // namespace asdfvk
