#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "core/error.h"

namespace asdfvk {

/// Entries sorted into numbered buckets, one after another: compressed rows.
template <typename Entry>
struct Buckets {
  std::vector<uint32_t> offsets;  ///< #buckets+1
  std::vector<Entry> entries;     ///< Ascending within each bucket.

  [[nodiscard]] uint32_t bucketCount() const { return static_cast<uint32_t>(offsets.size() - 1); }
  [[nodiscard]] std::span<const Entry> operator[](uint32_t bucket) const {
    return {entries.data() + offsets[bucket], entries.data() + offsets[bucket + 1]};
  }
};

/// Calls body(i) for every i in [0, count), in parallel.
template <typename Body>
void forEachInParallel(size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 1024), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) body(static_cast<uint32_t>(i));
  });
}

/// A parallel counting sort by bucket, then a sort within each bucket: linear as long as buckets are small, n log n at
/// worst, the same for any number of threads. emit(item, put) is called twice for every item in [0, itemCount) and
/// calls put(bucket, entry) for each of its entries. Throws Error{Input} beyond 2^32 - 1 entries.
template <typename Entry, typename Emit>
[[nodiscard]] Buckets<Entry> sortIntoBuckets(size_t bucketCount, size_t itemCount, const Emit& emit) {
  constexpr size_t kWorthParallelSort = size_t{1} << 16;
  Buckets<Entry> buckets;
  std::vector<uint32_t>& offsets = buckets.offsets;
  offsets.assign(bucketCount + 1, 0);
  const auto slot = [&](uint32_t bucket) { return std::atomic_ref<uint32_t>(offsets[bucket]); };
  forEachInParallel(itemCount, [&](uint32_t item) {
    emit(item, [&](uint32_t bucket, const Entry&) { slot(bucket).fetch_add(1, std::memory_order_relaxed); });
  });
  uint64_t total = 0;
  for (uint32_t& offset : offsets) {
    total += offset;
    if (total > UINT32_MAX) throw Error(ErrorKind::Input, "the mesh has too many connections; split it");
    offset = static_cast<uint32_t>(total);
  }
  // Each offset is now its bucket's end; filling backwards leaves the bucket's begin.
  buckets.entries.resize(total);
  forEachInParallel(itemCount, [&](uint32_t item) {
    emit(item, [&](uint32_t bucket, const Entry& entry) {
      buckets.entries[slot(bucket).fetch_sub(1, std::memory_order_relaxed) - 1] = entry;
    });
  });
  forEachInParallel(bucketCount, [&](uint32_t bucket) {
    const auto begin = buckets.entries.begin() + offsets[bucket], end = buckets.entries.begin() + offsets[bucket + 1];
    if (static_cast<size_t>(end - begin) < kWorthParallelSort) {
      std::sort(begin, end);
    } else {
      tbb::parallel_sort(begin, end);
    }
  });
  return buckets;
}

/// What stands in a bucket more than once is left once. Precondition: buckets are ascending.
template <typename Entry>
[[nodiscard]] Buckets<Entry> withoutRepeats(const Buckets<Entry>& buckets) {
  Buckets<Entry> result;
  result.offsets.push_back(0);
  for (uint32_t bucket = 0; bucket < buckets.bucketCount(); ++bucket) {
    const std::span<const Entry> entries = buckets[bucket];
    std::unique_copy(entries.begin(), entries.end(), std::back_inserter(result.entries));
    result.offsets.push_back(static_cast<uint32_t>(result.entries.size()));
  }
  return result;
}

}  // namespace asdfvk
