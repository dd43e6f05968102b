#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace asdfvk {

inline constexpr size_t kItemsPerTask = 4096;

/// Calls body(i) for every i in [0, count), in parallel. If body(i) writes only data of i, the result has the same bits
/// on any number of threads.
template <typename Body>
void forEachInParallel(size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, kItemsPerTask / 4),
                    [&](const tbb::blocked_range<size_t>& range) {
                      for (size_t i = range.begin(); i < range.end(); ++i) body(static_cast<uint32_t>(i));
                    });
}

/// The same for few and long bodies: each may run on a thread of its own.
template <typename Body>
void forEachTask(size_t count, const Body& body) {
  tbb::parallel_for(size_t{0}, count, [&](size_t i) { body(i); });
}

/// Number of i in [0, count) for which hold(i) is true, in parallel.
template <typename Holds>
[[nodiscard]] uint64_t countInParallel(size_t count, const Holds& holds) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, count, kItemsPerTask), uint64_t{0},
      [&](const tbb::blocked_range<size_t>& range, uint64_t found) {
        for (size_t i = range.begin(); i < range.end(); ++i) found += holds(static_cast<uint32_t>(i)) ? 1 : 0;
        return found;
      },
      [](uint64_t a, uint64_t b) { return a + b; });
}

/// The greatest valueOf(i), i in [0, count), and of Value{}, in parallel.
template <typename Value, typename ValueOf>
[[nodiscard]] Value maxInParallel(size_t count, const ValueOf& valueOf) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, count, kItemsPerTask), Value{},
      [&](const tbb::blocked_range<size_t>& range, Value greatest) {
        for (size_t i = range.begin(); i < range.end(); ++i)
          greatest = std::max(greatest, Value{valueOf(static_cast<uint32_t>(i))});
        return greatest;
      },
      [](const Value& a, const Value& b) { return std::max(a, b); });
}

}  // namespace asdfvk
