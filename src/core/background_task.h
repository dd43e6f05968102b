#pragma once

#include <functional>
#include <memory>

namespace asdfvk {

/// A task that runs on an idle thread of the pool that also runs the parallel loops (core/parallel.h). If no thread has
/// begun the task, wait() and the destructor run the task on the calling thread. A parallel loop of the creating thread
/// may run the task earlier, except within callIsolated().
class BackgroundTask {
 public:
  explicit BackgroundTask(std::function<void()> body);
  ~BackgroundTask();
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asdfvk
