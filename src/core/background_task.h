#pragma once

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <utility>

namespace asdfvk {

/// A task for idle threads of TBB. The thread that made it runs it in wait() if no other one has begun it.
class BackgroundTask {
 public:
  template <typename Body>
  explicit BackgroundTask(Body body) {
    group_.run(std::move(body));
  }
  ~BackgroundTask() {
    try {
      wait();
    } catch (...) {  // wait() has been called, or another exception has prevented it.
    }
  }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Runs `body` on this thread. Its parallel loops wait only for themselves: they do not begin the task.
  template <typename Body>
  static void meanwhile(const Body& body) {
    tbb::this_task_arena::isolate(body);
  }
  /// Throws what the task throws.
  void wait() { group_.wait(); }

 private:
  tbb::task_group group_;
};

}  // namespace asdfvk
