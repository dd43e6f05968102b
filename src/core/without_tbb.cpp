#include <algorithm>
#include <exception>
#include <utility>

#include "asdf_vk/run_control.h"
#include "core/background_task.h"
#include "core/parallel.h"

/// Parallel loops on one thread, for builds without TBB (WebAssembly).
namespace asdfvk {

size_t threadLimit() { return 1; }
size_t defaultThreadCount() { return 1; }

/// In ranges, because callers poll for a stop and report progress between them.
void forEachRange(size_t count, size_t grain, FunctionRef<void(size_t, size_t)> body) {
  for (size_t begin = 0; begin < count; begin += std::min(grain, count - begin))
    body(begin, begin + std::min(grain, count - begin));
}

struct RepeatedLoop::State {};
RepeatedLoop::RepeatedLoop() = default;
RepeatedLoop::~RepeatedLoop() = default;

void RepeatedLoop::forEachRange(size_t count, FunctionRef<void(size_t, size_t)> body) {
  if (count > 0) body(0, count);
}

void forEachInOrder(size_t count, size_t slotCount, FunctionRef<void(size_t, size_t)> make,
                    FunctionRef<void(size_t, size_t)> use) {
  for (size_t item = 0; item < count; ++item) {
    make(item, item % slotCount);
    use(item, item % slotCount);
  }
}

void callBoth(FunctionRef<void()> first, FunctionRef<void()> second) {
  first();
  second();
}

void callIsolated(FunctionRef<void()> body) { body(); }
void callWithThreads(uint32_t, FunctionRef<void()> body) { body(); }

struct PointerPerThread::State {
  void* pointer = nullptr;
};

PointerPerThread::PointerPerThread() : state_(std::make_unique<State>()) {}
PointerPerThread::~PointerPerThread() = default;

void*& PointerPerThread::local() { return state_->pointer; }
void PointerPerThread::forEach(FunctionRef<void(void*)> visit) { visit(state_->pointer); }

struct BackgroundTask::State {
  std::exception_ptr failure;
};

BackgroundTask::BackgroundTask(std::function<void()> body) : state_(std::make_unique<State>()) {
  try {
    body();
  } catch (...) {
    state_->failure = std::current_exception();
  }
}

BackgroundTask::~BackgroundTask() = default;

void BackgroundTask::wait() {
  if (const std::exception_ptr failure = std::exchange(state_->failure, nullptr)) std::rethrow_exception(failure);
}

struct ThreadLimit::State {};
ThreadLimit::ThreadLimit(uint32_t) {}
ThreadLimit::~ThreadLimit() = default;

}  // namespace asdfvk
