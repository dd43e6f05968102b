#include "core/bucket_sort.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "core/random.h"

using namespace asdfvk;

namespace {

struct Emission {
  uint32_t bucket = 0, entry = 0;
  auto operator<=>(const Emission&) const = default;
};

// Up to three entries an item; the first bucket gets as many as all the others.
std::vector<std::vector<Emission>> randomItems(size_t itemCount, uint32_t bucketCount, uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<Emission>> items(itemCount);
  for (auto& item : items)
    for (uint32_t i = random.index(4); i > 0; --i)
      item.push_back({random.index(2) == 0 ? 0 : random.index(bucketCount), random.index(1000)});
  return items;
}

template <typename Items>
auto emitterOf(const Items& items) {
  return [&items](uint32_t i, auto&& put) {
    for (const Emission& e : items[i]) put(e.bucket, e.entry);
  };
}

}  // namespace

TEST_CASE("entries are in their buckets, ascending, for any number of buckets, items and threads") {
  for (const size_t threadCount : {1, 4}) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, threadCount);
    for (const uint32_t bucketCount : {1u, 2u, 7u, 512u, 513u, 100'000u}) {
      for (const size_t itemCount : {size_t{0}, size_t{1}, size_t{100}, size_t{8192}, size_t{100'000}}) {
        CAPTURE(bucketCount);
        CAPTURE(itemCount);
        const auto items = randomItems(itemCount, bucketCount, itemCount + bucketCount);
        std::vector<Emission> sorted;
        for (const auto& item : items) sorted.insert(sorted.end(), item.begin(), item.end());
        std::sort(sorted.begin(), sorted.end());

        const Buckets<uint32_t> buckets = sortIntoBuckets<uint32_t>(bucketCount, itemCount, emitterOf(items));
        REQUIRE(buckets.bucketCount() == bucketCount);
        REQUIRE(buckets.entries.size() == sorted.size());
        std::vector<Emission> found;
        for (uint32_t bucket = 0; bucket < bucketCount; ++bucket)
          for (const uint32_t entry : buckets[bucket]) found.push_back({bucket, entry});
        CHECK(found == sorted);
      }
    }
  }
}

TEST_CASE("each bucket with an entry is visited once, with all of its entries") {
  constexpr uint32_t kBucketCount = 20'000;
  const auto items = randomItems(150'000, kBucketCount, 5);
  const StagedEntries<uint32_t> staged(kBucketCount, items.size(), emitterOf(items));
  const Buckets<uint32_t> buckets = staged.toBuckets();
  std::vector<uint32_t> visitCounts(kBucketCount, 0);
  std::atomic<uint32_t> differenceCount = 0;
  staged.forEachBucket([&](uint32_t bucket, std::span<const uint32_t> entries) {
    ++visitCounts[bucket];
    if (!std::equal(entries.begin(), entries.end(), buckets[bucket].begin(), buckets[bucket].end())) ++differenceCount;
  });
  CHECK(differenceCount == 0);
  for (uint32_t bucket = 0; bucket < kBucketCount; ++bucket)
    CHECK(visitCounts[bucket] == (buckets[bucket].empty() ? 0u : 1u));
}
