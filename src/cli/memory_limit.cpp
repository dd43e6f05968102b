#include "cli/memory_limit.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "batch/process_memory.h"

namespace asdfvk {
namespace {

constexpr auto kMeasureTime = std::chrono::milliseconds(10), kNextStopTime = std::chrono::milliseconds(100);

/// Returns freed memory to the system: else the next request would exceed the limit by the memory of an earlier one.
void releaseFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

MemoryLimit::MemoryLimit(uint64_t bytes) : bytes_(bytes) {
  if (bytes_ > 0) watcher_ = std::jthread([this](const std::stop_token& ending) { watch(ending); });
}

MemoryLimit::Request::Request(MemoryLimit& limit, uint64_t byteCount, const std::stop_token& outer)
    : limit_(limit), byteCount_(byteCount), forward_(outer, Forward{source_}) {
  const std::lock_guard<std::mutex> lock(limit_.mutex_);
  limit_.requests_.push_back(this);
}

MemoryLimit::Request::~Request() {
  const std::lock_guard<std::mutex> lock(limit_.mutex_);
  limit_.requests_.remove(this);
}

bool MemoryLimit::Request::hasExceeded() const {
  const std::lock_guard<std::mutex> lock(limit_.mutex_);
  return hasExceeded_;
}

void MemoryLimit::watch(const std::stop_token& ending) {
  while (!ending.stop_requested()) {
    std::this_thread::sleep_for(kMeasureTime);
    if (residentBytesOf(getpid()) <= bytes_) continue;
    releaseFreedMemory();
    if (residentBytesOf(getpid()) > bytes_ && stopLargest()) std::this_thread::sleep_for(kNextStopTime);
  }
}

bool MemoryLimit::stopLargest() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Request* largest = nullptr;
  for (Request* const request : requests_)
    if (!request->hasExceeded_ && (largest == nullptr || request->byteCount_ > largest->byteCount_)) largest = request;
  if (largest == nullptr) return false;
  largest->hasExceeded_ = true;
  largest->source_.request_stop();
  return true;
}

}  // namespace asdfvk
