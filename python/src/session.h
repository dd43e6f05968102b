#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "asdf_vk/scene.h"
#include "asdf_vk/session.h"
#include "describe/computation_options.h"

namespace asdfvk::python {

/// A session for Python. Any number of threads may call it; one computation runs at a time.
class SharedSession {
 public:
  /// Throws Error{ForkedProcess} and the errors of Session().
  explicit SharedSession(const SessionSettings& settings);
  /// Releases nothing in a forked process, where the threads of the device do not exist.
  ~SharedSession();
  SharedSession(const SharedSession&) = delete;
  SharedSession& operator=(const SharedSession&) = delete;

  [[nodiscard]] const Session& session() const { return *session_; }

  /// Runs `work` when no other thread uses the session; see runInterruptibly().
  void run(const std::function<void(Session&, const RunControl&)>& work, const pybind11::object& progress);
  /// Destroys a scene of this session. If another thread uses the session, this happens before the next use.
  void release(std::unique_ptr<Scene> scene);

 private:
  std::unique_ptr<Session> session_;
  uint32_t threadCount_;
  std::timed_mutex mutex_;
  /// Guards `released_`. May be locked during a try to lock `mutex_`, but not during a wait for `mutex_`.
  std::mutex releasedMutex_;
  std::vector<std::unique_ptr<Scene>> released_;  ///< Destroyed before the session.
};

}  // namespace asdfvk::python
