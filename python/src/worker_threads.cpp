#include "worker_threads.h"

#include <condition_variable>
#include <mutex>
#include <queue>
#include <thread>
#include <utility>

namespace asdfvk::python {
namespace {

class Workers {
 public:
  void run(std::packaged_task<void()> task) {
    {
      const std::lock_guard lock(mutex_);
      if (idle_ <= tasks_.size()) std::thread([this] { work(); }).detach();
      tasks_.push(std::move(task));
      ++unfinished_;
    }
    ready_.notify_one();
  }

  void wait() {
    std::unique_lock lock(mutex_);
    finished_.wait(lock, [this] { return unfinished_ == 0; });
  }

 private:
  [[noreturn]] void work() {
    for (std::unique_lock lock(mutex_);;) {
      ++idle_;
      ready_.wait(lock, [this] { return !tasks_.empty(); });
      --idle_;
      std::packaged_task<void()> task = std::move(tasks_.front());
      tasks_.pop();
      lock.unlock();
      task();
      lock.lock();
      --unfinished_;
      finished_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable ready_, finished_;
  std::queue<std::packaged_task<void()>> tasks_;
  size_t idle_ = 0;
  size_t unfinished_ = 0;  ///< Tasks that wait or run.
};

Workers& workers() {
  // Not destroyed at exit, when threads still wait in it.
  static auto* workers = new Workers;
  return *workers;
}

}  // namespace

void runOnWorker(std::packaged_task<void()> task) { workers().run(std::move(task)); }

void waitForWorkers() { workers().wait(); }

}  // namespace asdfvk::python
