#include "cli/request_sessions.h"

#include <chrono>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "pipeline/backend_choice.h"

namespace asdfvk {
namespace {

constexpr auto kSessionPollTime = std::chrono::milliseconds(5);

void callWith(std::unique_ptr<Session>& session, const SessionOptions& options, FunctionRef<bool(Session&)> use) {
  if (!session) session = std::make_unique<Session>(options, SessionOpening::InThread);
  if (!use(*session)) session.reset();
}

}  // namespace

RequestSessions::RequestSessions(SessionOptions options, size_t workerCount)
    : options_(std::move(options)), threadCount_(static_cast<uint32_t>(threadLimit())), own_(workerCount) {}

void RequestSessions::call(size_t worker, const Options& options, const std::stop_token& stop,
                           FunctionRef<bool(Session&)> use) {
  const SessionOptions chosen = sessionOptionsFor(options_, options);
  if (!mayUseDevice(chosen.backend)) return callWith(own_[worker][chosen.backend], chosen, use);
  std::unique_lock<std::timed_mutex> lock(sharing_, std::defer_lock);
  while (!lock.try_lock_for(kSessionPollTime))
    if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
  // A CPU device keeps the number of threads with which it is opened, so it must not be the share of this request.
  if (!shared_)
    callWithThreads(threadCount_, [&] { shared_ = std::make_unique<Session>(chosen, SessionOpening::InThread); });
  callWith(shared_, chosen, use);
}

}  // namespace asdfvk
