#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "asdf_vk/session.h"
#include "core/function_ref.h"

namespace asdfvk {

/// The sessions of a server. Computations that may use a device share one session, one after another, so that the
/// device is opened once. Computations without a device have a session per thread.
class RequestSessions {
 public:
  RequestSessions(SessionOptions options, size_t workerCount);

  /// Calls `use` with a session for these options. `use` returns whether its session can be used again. worker: the
  /// index of the thread. Throws Error{Cancelled} if a stop is requested while the session is in use.
  void call(size_t worker, const Options& options, const std::stop_token& stop, FunctionRef<bool(Session&)> use);

 private:
  const SessionOptions options_;
  const uint32_t threadCount_;
  std::timed_mutex sharing_;
  std::unique_ptr<Session> shared_;
  std::vector<std::map<BackendChoice, std::unique_ptr<Session>>> own_;  ///< For each worker.
};

}  // namespace asdfvk
