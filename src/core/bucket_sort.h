#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "core/unset_vector.h"

namespace asdfvk {

/// Entries grouped into numbered buckets, in the layout of compressed sparse rows.
template <typename Entry>
struct Buckets {
  UnsetVector<uint32_t> offsets;  ///< #buckets+1
  UnsetVector<Entry> entries;     ///< In the order of the buckets, ascending within each bucket.

  [[nodiscard]] uint32_t bucketCount() const { return static_cast<uint32_t>(offsets.size() - 1); }
  [[nodiscard]] std::span<const Entry> operator[](uint32_t bucket) const {
    return {entries.data() + offsets[bucket], entries.data() + offsets[bucket + 1]};
  }
};

/// Groups entries by bucket number, for callers that read each bucket once and keep no bucket. A radix sort in two
/// steps. In the second step, each run of buckets fits into a cache. The sort avoids atomic operations, which wait for
/// memory. Time: linear for small buckets, n log n in the worst case. The result does not depend on the number of
/// threads. Entry has operator<. The default constructor of Entry should leave the entry uninitialised, because all
/// entries are overwritten.
template <typename Entry>
class StagedEntries {
 public:
  /// emit(item, put) is called twice for every item in [0, itemCount) and calls put(bucket, entry) for each entry of
  /// the item. Throws Error{Input} beyond 2^32 - 1 entries.
  template <typename Emit>
  StagedEntries(size_t bucketCount, size_t itemCount, const Emit& emit) : bucketCount_(bucketCount) {
    const size_t wantedRunCount = std::clamp<size_t>(itemCount / kItemsPerRun, 1, kMaxRunCount);
    while ((bucketCount >> shift_) >= wantedRunCount && bucketCount >> shift_ > 0) ++shift_;
    const size_t runCount = (bucketCount >> shift_) + 1;
    const size_t blockSize = std::max(kItemsPerRun, itemCount / kMaxBlockCount + 1);
    const size_t blockCount = (itemCount + blockSize - 1) / blockSize;
    std::vector<std::vector<uint32_t>> cursors(blockCount);
    const auto forEachBlock = [&](const auto& body) {
      forEachTask(blockCount, [&](size_t block) {
        const size_t end = std::min(itemCount, (block + 1) * blockSize);
        for (size_t item = block * blockSize; item < end; ++item) body(cursors[block], static_cast<uint32_t>(item));
      });
    };
    for (std::vector<uint32_t>& cursor : cursors) cursor.assign(runCount, 0);
    forEachBlock([&](std::vector<uint32_t>& counts, uint32_t item) {
      emit(item, [&](uint32_t bucket, const Entry&) { ++counts[bucket >> shift_]; });
    });
    turnIntoCursors(cursors, runCount);
    staged_ = std::make_unique_for_overwrite<Staged[]>(count());
    forEachBlock([&](std::vector<uint32_t>& cursor, uint32_t item) {
      emit(item, [&](uint32_t bucket, const Entry& entry) { staged_[cursor[bucket >> shift_]++] = {bucket, entry}; });
    });
  }

  [[nodiscard]] uint32_t count() const { return runBegins_.back(); }

  /// Calls visit(bucket, entries) once for each non-empty bucket, in parallel. The entries are ascending.
  template <typename Visit>
  void forEachBucket(const Visit& visit) const {
    PerThread<std::vector<Entry>> scratches;
    forEachRun(
        [&](uint32_t, uint32_t size) {
          std::vector<Entry>& scratch = scratches.local();
          if (scratch.size() < size) scratch.resize(size);
          return scratch.data();
        },
        [&](uint32_t bucket, uint32_t, std::span<const Entry> entries) {
          if (!entries.empty()) visit(bucket, entries);
        });
  }

  [[nodiscard]] Buckets<Entry> toBuckets() const {
    Buckets<Entry> buckets;
    buckets.offsets.resize(bucketCount_ + 1);
    buckets.entries.resize(count());
    forEachRun([&](uint32_t begin, uint32_t) { return buckets.entries.data() + begin; },
               [&](uint32_t bucket, uint32_t begin, std::span<const Entry>) { buckets.offsets[bucket] = begin; });
    buckets.offsets.back() = count();
    return buckets;
  }

 private:
  static constexpr size_t kItemsPerRun = size_t{1} << 13, kMaxRunCount = 512, kMaxBlockCount = 256;

  struct Staged {
    uint32_t bucket;
    Entry entry;
  };

  /// Replaces each counts[block][run], a number of entries, by the position of the first of these entries.
  void turnIntoCursors(std::vector<std::vector<uint32_t>>& counts, size_t runCount) {
    uint64_t total = 0;
    for (size_t run = 0; run < runCount; ++run) {
      runBegins_.push_back(static_cast<uint32_t>(total));
      for (std::vector<uint32_t>& count : counts) {
        total += std::exchange(count[run], static_cast<uint32_t>(total));
        if (total > UINT32_MAX)
          throw Error(ErrorCode::MeshTooLarge,
                      "the mesh is too large: a table of its vertices and faces needs more than 2^32 entries");
      }
    }
    runBegins_.push_back(static_cast<uint32_t>(total));
  }

  static void sort(std::span<Entry> entries) {
    constexpr size_t kWorthParallelSort = size_t{1} << 16;
    if (entries.size() >= kWorthParallelSort) {
      // Isolated, because the thread must not start another run during the sort: that run would overwrite the scratch
      // memory.
      callIsolated([&] { sortInParallel(entries.begin(), entries.end()); });
    } else if (entries.size() > 1) {
      std::sort(entries.begin(), entries.end());
    }
  }

  /// room(begin, size) returns the memory for the entries of a run. visit(bucket, begin, entries) is called for each
  /// bucket. begin: position of the first entry of the run or bucket among all entries in bucket order.
  template <typename Room, typename Visit>
  void forEachRun(const Room& room, const Visit& visit) const {
    PerThread<std::vector<uint32_t>> ends;
    forEachTask(runBegins_.size() - 1, [&](size_t run) {
      const uint32_t begin = runBegins_[run], size = runBegins_[run + 1] - begin;
      const size_t firstBucket = run << shift_;
      const size_t runBucketCount = std::min(bucketCount_, (run + 1) << shift_) - firstBucket;
      const std::span<const Staged> staged(staged_.get() + begin, size);
      std::vector<uint32_t>& end = ends.local();
      end.assign(runBucketCount + 1, 0);
      for (const Staged& s : staged) ++end[s.bucket - firstBucket + 1];
      for (size_t i = 1; i <= runBucketCount; ++i) end[i] += end[i - 1];
      Entry* entries = room(begin, size);
      for (const Staged& s : staged) entries[end[s.bucket - firstBucket]++] = s.entry;
      for (size_t i = 0; i < runBucketCount; ++i) {
        const uint32_t from = i == 0 ? 0 : end[i - 1];
        const std::span<Entry> bucket(entries + from, entries + end[i]);
        sort(bucket);
        visit(static_cast<uint32_t>(firstBucket + i), begin + from, bucket);
      }
    });
  }

  size_t bucketCount_ = 0;
  uint32_t shift_ = 0;                ///< Buckets whose numbers differ only in this many low bits form a run.
  std::vector<uint32_t> runBegins_;   ///< #runs+1
  std::unique_ptr<Staged[]> staged_;  ///< Entries with their bucket numbers, grouped by run.
};

template <typename Entry, typename Emit>
[[nodiscard]] Buckets<Entry> sortIntoBuckets(size_t bucketCount, size_t itemCount, const Emit& emit) {
  return StagedEntries<Entry>(bucketCount, itemCount, emit).toBuckets();
}

}  // namespace asdfvk
