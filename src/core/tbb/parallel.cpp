#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "asdf_vk/run_control.h"
#include "core/background_task.h"

namespace asdfvk {

namespace {

thread_local size_t threadCountOfCall = SIZE_MAX;  // The argument of callWithThreads() on this thread.

}  // namespace

size_t threadLimit() {
  return std::min(threadCountOfCall, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

size_t defaultThreadCount() { return static_cast<size_t>(tbb::info::default_concurrency()); }

void forEachRange(size_t count, size_t grain, FunctionRef<void(size_t, size_t)> body) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain),
                    [&](const tbb::blocked_range<size_t>& range) { body(range.begin(), range.end()); });
}

struct RepeatedLoop::State {
  tbb::affinity_partitioner partitioner;
};

RepeatedLoop::RepeatedLoop() : state_(std::make_unique<State>()) {}
RepeatedLoop::~RepeatedLoop() = default;

void RepeatedLoop::forEachRange(size_t count, FunctionRef<void(size_t, size_t)> body) {
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, count),
      [&](const tbb::blocked_range<size_t>& range) { body(range.begin(), range.end()); }, state_->partitioner);
}

void forEachInOrder(size_t count, size_t slotCount, FunctionRef<void(size_t, size_t)> make,
                    FunctionRef<void(size_t, size_t)> use) {
  if (count == 0) return;
  size_t next = 0;
  const auto begin = tbb::make_filter<void, size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
    if (next == count) flow.stop();
    return next++;
  });
  const auto middle = tbb::make_filter<size_t, size_t>(tbb::filter_mode::parallel, [&](size_t item) {
    make(item, item % slotCount);
    return item;
  });
  const auto end = tbb::make_filter<size_t, void>(tbb::filter_mode::serial_in_order,
                                                  [&](size_t item) { use(item, item % slotCount); });
  tbb::parallel_pipeline(slotCount, begin & middle & end);
}

void callBoth(FunctionRef<void()> first, FunctionRef<void()> second) { tbb::parallel_invoke(first, second); }

void callIsolated(FunctionRef<void()> body) { tbb::this_task_arena::isolate(body); }

void callWithThreads(uint32_t threadCount, FunctionRef<void()> body) {
  struct Restore {
    size_t outer;
    ~Restore() { threadCountOfCall = outer; }
  };
  const Restore restore{std::exchange(threadCountOfCall, size_t{threadCount})};
  tbb::task_arena(static_cast<int>(threadCount)).execute(body);
}

struct PointerPerThread::State {
  tbb::enumerable_thread_specific<void*> pointers{nullptr};
};

PointerPerThread::PointerPerThread() : state_(std::make_unique<State>()) {}
PointerPerThread::~PointerPerThread() = default;

void*& PointerPerThread::local() { return state_->pointers.local(); }

void PointerPerThread::forEach(FunctionRef<void(void*)> visit) {
  for (void* pointer : state_->pointers) visit(pointer);
}

struct BackgroundTask::State {
  tbb::task_group group;
};

BackgroundTask::BackgroundTask(std::function<void()> body) : state_(std::make_unique<State>()) {
  state_->group.run(std::move(body));
}

BackgroundTask::~BackgroundTask() {
  try {
    wait();
  } catch (...) {  // The caller has already received this exception from wait(), or is handling another exception.
  }
}

void BackgroundTask::wait() { state_->group.wait(); }

struct ThreadLimit::State {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(uint32_t threadCount) {
  if (threadCount == 0) return;
  state_.reset(new State{tbb::global_control(tbb::global_control::max_allowed_parallelism, threadCount)});
}
ThreadLimit::~ThreadLimit() = default;

}  // namespace asdfvk
