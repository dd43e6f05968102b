#pragma once

#include <functional>
#include <memory>

namespace asdfvk {

/// A task for an idle thread of the parallel loops. If no thread has begun it, wait() and the destructor run it on the
/// calling thread. A parallel loop of the creating thread may run it earlier, except within callIsolated().
class BackgroundTask {
 public:
  explicit BackgroundTask(std::function<void()> body);
  ~BackgroundTask();
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Waits for the end of the task. Throws what the task throws.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asdfvk
