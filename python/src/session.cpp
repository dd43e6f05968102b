#include "session.h"

#include <chrono>
#include <utility>

#include "interruptible.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

constexpr auto kLockInterval = std::chrono::milliseconds(20);

}  // namespace

SharedSession::SharedSession(const SessionSettings& settings) : threadCount_(settings.threadCount) {
  requireSameProcess();
  runInterruptibly(
      [&](const RunControl&) {
        const ThreadLimit limit(threadCount_);
        session_ = std::make_unique<Session>(settings);
      },
      py::none());
}

SharedSession::~SharedSession() {
  if (!isForkedProcess()) return;
  for (std::unique_ptr<Scene>& scene : released_) (void)scene.release();
  (void)session_.release();
}

void SharedSession::run(const std::function<void(Session&, const RunControl&)>& work, const py::object& progress) {
  requireSameProcess();
  runInterruptibly(
      [&](const RunControl& control) {
        std::unique_lock<std::timed_mutex> lock(mutex_, std::defer_lock);
        while (!lock.try_lock_for(kLockInterval)) control.checkpoint(0);
        const ThreadLimit limit(threadCount_);
        {
          const std::scoped_lock releasedLock(releasedMutex_);
          released_.clear();
        }
        work(*session_, control);
      },
      progress);
}

void SharedSession::release(std::unique_ptr<Scene> scene) {
  const std::scoped_lock releasedLock(releasedMutex_);
  released_.push_back(std::move(scene));
  const std::unique_lock<std::timed_mutex> lock(mutex_, std::try_to_lock);
  if (lock) released_.clear();
}

}  // namespace asdfvk::python
