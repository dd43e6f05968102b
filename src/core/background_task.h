#pragma once

#include <functional>
#include <memory>

namespace asdfvk {

/// A task for idle threads of the parallel loops. The thread that made it runs it in wait() if no other one has begun
/// it; callIsolated() keeps it from that before.
class BackgroundTask {
 public:
  explicit BackgroundTask(std::function<void()> body);
  ~BackgroundTask();
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Throws what the task throws.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asdfvk
