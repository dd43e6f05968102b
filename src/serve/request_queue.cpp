#include "serve/request_queue.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace asdfvk {

RequestQueue::RequestQueue(size_t threadCount, size_t maxBytes, Write write, const std::stop_token& stop)
    : threadCount_(std::max<size_t>(threadCount, 1)),
      maxBytes_(maxBytes),
      write_(std::move(write)),
      onStop_(stop, StopAll{*this}) {
  for (size_t i = 0; i < threadCount_; ++i) threads_.emplace_back([this, i] { runRequests(i); });
}

RequestQueue::~RequestQueue() {
  stopAll();
  try {
    finish();
  } catch (...) {  // NOLINT(bugprone-empty-catch): the caller did not ask for the error.
  }
}

void RequestQueue::add(Json id, size_t byteCount, Work work) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] {
    return stop_.stop_requested() || waiting_.empty() ||
           (waitingBytes_ + byteCount <= maxBytes_ && waiting_.size() < kMaxWaiting);
  });
  waiting_.push_back({std::move(id), byteCount, std::move(work)});
  waitingBytes_ += byteCount;
  if (stop_.stop_requested()) waiting_.back().stop.request_stop();
  changed_.notify_all();
}

bool RequestQueue::cancel(const Json& id) {
  if (id.is_null()) return false;  // Requests without an id.
  const std::lock_guard<std::mutex> lock(mutex_);
  bool isFound = false;
  for (Entries* const entries : {&waiting_, &running_})
    for (Entry& entry : *entries)
      if (entry.id == id) {
        entry.stop.request_stop();
        isFound = true;
      }
  return isFound;
}

void RequestQueue::answer(std::string_view line) {
  try {
    write_(line);
  } catch (...) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
    stopAll();
  }
}

void RequestQueue::finish() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    isFinished_ = true;
    changed_.notify_all();
  }
  for (std::jthread& thread : threads_)
    if (thread.joinable()) thread.join();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void RequestQueue::runRequests(size_t worker) {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return isFinished_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    running_.splice(running_.end(), waiting_, waiting_.begin());
    const auto entry = std::prev(running_.end());
    waitingBytes_ -= entry->byteCount;
    const RequestContext context{worker, std::min(threadCount_, running_.size() + waiting_.size()),
                                 entry->stop.get_token(), entry->byteCount};
    changed_.notify_all();
    lock.unlock();
    std::exception_ptr failure;
    try {
      const std::string line = entry->work(context);
      if (!line.empty()) answer(line);
    } catch (...) {  // For example, there is no memory for the answer. The other requests go on.
      failure = std::current_exception();
    }
    lock.lock();
    if (failure && !failure_) failure_ = failure;
    running_.erase(entry);
  }
}

void RequestQueue::stopAll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stop_.request_stop();
  for (Entries* const entries : {&waiting_, &running_})
    for (Entry& entry : *entries) entry.stop.request_stop();
  changed_.notify_all();
}

}  // namespace asdfvk
