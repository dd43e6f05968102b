#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "asdf_vk/scene.h"
#include "asdf_vk/session.h"
#include "describe/session_options.h"

namespace asdfvk::python {

/// A session for Python. Any number of threads may call its functions; one computation runs at a time.
class SharedSession {
 public:
  /// Throws Error{ForkedProcess} and the errors of Session().
  explicit SharedSession(const SessionSettings& settings);
  /// In a forked process the destructor releases nothing, because the threads of the device do not exist there.
  ~SharedSession();
  SharedSession(const SharedSession&) = delete;
  SharedSession& operator=(const SharedSession&) = delete;

  [[nodiscard]] const Session& session() const { return *session_; }

  /// Waits until no other thread uses the session, and runs `work` by runInterruptibly().
  void run(const std::function<void(Session&, const RunControl&)>& work, const pybind11::object& progress);
  /// Destroys a scene of this session. If another thread uses the session, the scene is destroyed before the next use
  /// of the session.
  void release(std::unique_ptr<Scene> scene);

 private:
  std::unique_ptr<Session> session_;
  uint32_t threadCount_;
  std::timed_mutex mutex_;
  /// Guards `released_`. A thread that holds this mutex may try to lock `mutex_`, but must not wait for `mutex_`.
  std::mutex releasedMutex_;
  std::vector<std::unique_ptr<Scene>> released_;  ///< Destroyed before the session.
};

}  // namespace asdfvk::python
