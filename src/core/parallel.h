#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/function_ref.h"
#include "core/unset_vector.h"

/// Parallel loops by TBB; in a build without TBB, on one thread. Only tbb/parallel.cpp includes TBB, because the
/// headers of TBB have 94,000 lines. Therefore tbb/parallel.cpp also defines BackgroundTask and ThreadLimit.
namespace asdfvk {

inline constexpr size_t kItemsPerTask = 4096;

/// The greatest number of threads of a loop that this thread begins, by ThreadLimit and callWithThreads().
[[nodiscard]] size_t threadLimit();
/// The number of threads if no limit exists.
[[nodiscard]] size_t defaultThreadCount();

/// Calls body(begin, end) in parallel for disjoint ranges whose union is [0, count). Ranges of more than `grain` items
/// may be divided.
void forEachRange(size_t count, size_t grain, FunctionRef<void(size_t begin, size_t end)> body);

/// A loop that runs many times over the same items. Each thread gets the same ranges in each run, so that the data of
/// these ranges stay in its cache.
class RepeatedLoop {
 public:
  RepeatedLoop();
  ~RepeatedLoop();
  void forEachRange(size_t count, FunctionRef<void(size_t begin, size_t end)> body);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Calls make(item, slot) for every item in [0, count), in parallel, and after each of these calls use(item, slot). The
/// calls of `use` are in ascending order and never at the same time. At most slotCount items have begun and are not yet
/// used. These items have different slots in [0, slotCount).
void forEachInOrder(size_t count, size_t slotCount, FunctionRef<void(size_t item, size_t slot)> make,
                    FunctionRef<void(size_t item, size_t slot)> use);

void callBoth(FunctionRef<void()> first, FunctionRef<void()> second);

/// Calls `body` on this thread. While a parallel loop of `body` waits, this thread runs only tasks that `body` created.
void callIsolated(FunctionRef<void()> body);

/// Calls `body` on this thread. The parallel loops of `body` use at most `threadCount` threads, this thread included.
void callWithThreads(uint32_t threadCount, FunctionRef<void()> body);

/// Calls body(i) for every i in [0, count), in parallel. If body(i) writes only data of i, the result has the same bits
/// on any number of threads.
template <typename Body>
void forEachInParallel(size_t count, const Body& body) {
  forEachRange(count, kItemsPerTask / 4, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) body(static_cast<uint32_t>(i));
  });
}

/// Like forEachInParallel(), for few long calls: each call may run on a separate thread.
template <typename Body>
void forEachTask(size_t count, const Body& body) {
  forEachRange(count, 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) body(i);
  });
}

/// `count` copies of a value.
template <typename T>
[[nodiscard]] UnsetVector<T> filledInParallel(size_t count, const T& value) {
  UnsetVector<T> copies(count);
  forEachRange(count, kItemsPerTask,
               [&](size_t begin, size_t end) { std::fill(copies.data() + begin, copies.data() + end, value); });
  return copies;
}

/// The entries of a table at these indices. Entries: std::vector or UnsetVector.
template <typename Entries>
[[nodiscard]] Entries entriesAt(std::span<const uint32_t> indices,
                                std::span<const typename Entries::value_type> table) {
  Entries entries(indices.size());
  forEachInParallel(indices.size(), [&](size_t i) { entries[i] = table[indices[i]]; });
  return entries;
}

/// Reduction of [0, count). fold(begin, end) computes the value of each block of kBlockSize items, in parallel.
/// joined(a, b) then combines Value{} with the values of the blocks, in ascending order. The result has the same bits
/// on any number of threads.
template <typename Value, size_t kBlockSize = kItemsPerTask, typename Fold, typename Joined>
[[nodiscard]] Value foldInParallel(size_t count, const Fold& fold, const Joined& joined) {
  std::vector<Value> values((count + kBlockSize - 1) / kBlockSize);
  forEachTask(values.size(), [&](size_t block) {
    values[block] = fold(block * kBlockSize, std::min(count, (block + 1) * kBlockSize));
  });
  Value result{};
  for (const Value& value : values) result = joined(std::move(result), value);
  return result;
}

template <typename Holds>
[[nodiscard]] uint64_t countInParallel(size_t count, const Holds& holds) {
  const auto countOf = [&](size_t begin, size_t end) {
    uint64_t found = 0;
    for (size_t i = begin; i < end; ++i) found += holds(static_cast<uint32_t>(i)) ? 1 : 0;
    return found;
  };
  return foldInParallel<uint64_t>(count, countOf, std::plus<>());
}

template <typename Value, typename ValueOf>
[[nodiscard]] Value maxInParallel(size_t count, const ValueOf& valueOf) {
  const auto greater = [](const Value& a, const Value& b) { return std::max(a, b); };
  const auto greatestOf = [&](size_t begin, size_t end) {
    Value greatest{};
    for (size_t i = begin; i < end; ++i) greatest = std::max(greatest, Value{valueOf(static_cast<uint32_t>(i))});
    return greatest;
  };
  return foldInParallel<Value>(count, greatestOf, greater);
}

/// Returns the items for which holds(item) is true, in the order of their indices. itemAt(i): item i of [0, count).
template <typename ItemAt, typename Holds>
[[nodiscard]] std::vector<uint32_t> selectInParallel(size_t count, const ItemAt& itemAt, const Holds& holds) {
  constexpr size_t kBlockSize = 4 * kItemsPerTask;
  std::vector<std::vector<uint32_t>> blocks((count + kBlockSize - 1) / kBlockSize);
  forEachTask(blocks.size(), [&](size_t block) {
    for (size_t i = block * kBlockSize; i < std::min(count, (block + 1) * kBlockSize); ++i)
      if (const uint32_t item = itemAt(i); holds(item)) blocks[block].push_back(item);
  });
  std::vector<size_t> places(1, 0);
  for (const std::vector<uint32_t>& block : blocks) places.push_back(places.back() + block.size());
  std::vector<uint32_t> selected(places.back());
  forEachTask(blocks.size(), [&](size_t block) {
    std::copy(blocks[block].begin(), blocks[block].end(),
              selected.begin() + static_cast<std::ptrdiff_t>(places[block]));
  });
  return selected;
}

/// Returns the items for which holds(item) is true, in their order.
template <typename Holds>
[[nodiscard]] std::vector<uint32_t> selectInParallel(std::span<const uint32_t> items, const Holds& holds) {
  return selectInParallel(
      items.size(), [&](size_t i) { return items[i]; }, holds);
}

/// Returns the indices i in [0, count) with holds(i), in ascending order. Precondition: count is at most 2^32.
template <typename Holds>
[[nodiscard]] std::vector<uint32_t> indicesInParallel(size_t count, const Holds& holds) {
  return selectInParallel(
      count, [](size_t i) { return static_cast<uint32_t>(i); }, holds);
}

/// Sorts by `less`, in parallel if the range is long. Not stable, but the order is the same on any number of threads.
/// The last merge runs on one thread.
template <typename Iterator, typename Less = std::less<>>
void sortInParallel(Iterator begin, Iterator end, const Less& less = {}) {
  constexpr auto kWorthDividing = 1 << 15;
  if (end - begin <= kWorthDividing) return std::sort(begin, end, less);
  const Iterator middle = begin + (end - begin) / 2;
  callBoth([&] { sortInParallel(begin, middle, less); }, [&] { sortInParallel(middle, end, less); });
  std::inplace_merge(begin, middle, end, less);
}

/// One pointer per thread, initially null.
class PointerPerThread {
 public:
  PointerPerThread();
  ~PointerPerThread();
  [[nodiscard]] void*& local();
  void forEach(FunctionRef<void(void*)> visit);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// One Value per thread. make() creates the Value when the thread calls local() for the first time.
template <typename Value>
class PerThread {
 public:
  explicit PerThread(std::function<Value()> make = [] { return Value(); }) : make_(std::move(make)) {}
  ~PerThread() {
    forEach([](Value& value) { delete &value; });
  }
  PerThread(const PerThread&) = delete;
  PerThread& operator=(const PerThread&) = delete;

  [[nodiscard]] Value& local() {
    void*& pointer = pointers_.local();
    if (pointer == nullptr) pointer = new Value(make_());
    return *static_cast<Value*>(pointer);
  }
  /// On this thread, calls visit(value) for each value that was made. The order is not defined.
  template <typename Visit>
  void forEach(const Visit& visit) {
    pointers_.forEach([&](void* pointer) {
      if (pointer != nullptr) visit(*static_cast<Value*>(pointer));
    });
  }

 private:
  std::function<Value()> make_;
  PointerPerThread pointers_;
};

}  // namespace asdfvk
