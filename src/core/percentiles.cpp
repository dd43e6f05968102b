#include "core/percentiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr uint32_t kBucketBits = 12;
constexpr size_t kBucketCount = size_t{1} << kBucketBits, kBlockSize = size_t{1} << 16;

/// Keys have the order of the finite numbers.
uint64_t keyOf(double number) {
  constexpr uint64_t kSign = uint64_t{1} << 63;
  const auto bits = std::bit_cast<uint64_t>(number);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

struct KeyRange {
  uint64_t low = std::numeric_limits<uint64_t>::max(), high = 0;

  void add(uint64_t key) {
    low = std::min(low, key);
    high = std::max(high, key);
  }
  [[nodiscard]] bool isEmpty() const { return low > high; }
};

KeyRange keyRangeOf(std::span<const double> numbers) {
  const auto rangeOf = [&](size_t begin, size_t end) {
    KeyRange range;
    for (const double number : numbers.subspan(begin, end - begin))
      if (std::isfinite(number)) range.add(keyOf(number));
    return range;
  };
  return foldInParallel<KeyRange, kBlockSize>(numbers.size(), rangeOf, [](const KeyRange& a, const KeyRange& b) {
    return KeyRange{std::min(a.low, b.low), std::max(a.high, b.high)};
  });
}

/// Divides the keys of a range into buckets of equal width.
class KeyBuckets {
 public:
  explicit KeyBuckets(const KeyRange& range)
      : low_(range.low),
        shift_(std::max(static_cast<uint32_t>(std::bit_width(range.high - range.low)), kBucketBits) - kBucketBits) {}
  [[nodiscard]] size_t of(double number) const { return (keyOf(number) - low_) >> shift_; }

 private:
  uint64_t low_;
  uint32_t shift_;
};

using Counts = std::array<uint64_t, kBucketCount>;

Counts countsOf(std::span<const double> numbers, const KeyBuckets& buckets) {
  const auto countBlock = [&](size_t begin, size_t end) {
    Counts counts{};
    for (const double number : numbers.subspan(begin, end - begin))
      if (std::isfinite(number)) ++counts[buckets.of(number)];
    return counts;
  };
  return foldInParallel<Counts, kBlockSize>(numbers.size(), countBlock, [](Counts a, const Counts& b) {
    for (size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
  });
}

/// For each bucket the index of its list in Lists, or kNoList.
using ListOfBucket = std::array<uint8_t, kBucketCount>;
constexpr uint8_t kNoList = std::numeric_limits<uint8_t>::max();
using Lists = std::vector<std::vector<double>>;

/// The members of the buckets that have a list.
Lists membersOf(const ListOfBucket& listOf, size_t listCount, std::span<const double> numbers,
                const KeyBuckets& buckets) {
  const auto collect = [&](size_t begin, size_t end) {
    Lists lists(listCount);
    for (const double number : numbers.subspan(begin, end - begin))
      if (std::isfinite(number))
        if (const uint8_t list = listOf[buckets.of(number)]; list != kNoList) lists[list].push_back(number);
    return lists;
  };
  return foldInParallel<Lists, kBlockSize>(numbers.size(), collect, [](Lists all, const Lists& further) {
    all.resize(further.size());
    for (size_t i = 0; i < all.size(); ++i) all[i].insert(all[i].end(), further[i].begin(), further[i].end());
    return all;
  });
}

/// The number at index `rank` in ascending order of the members of the bucket.
struct Place {
  size_t bucket = 0;
  uint64_t rank = 0;
};

Place placeOf(uint64_t rank, const Counts& counts) {
  Place place{.bucket = 0, .rank = rank};
  for (; place.rank >= counts[place.bucket]; ++place.bucket) place.rank -= counts[place.bucket];
  return place;
}

}  // namespace

std::vector<double> percentilesOf(std::span<const double> numbers, std::span<const double> shares) {
  const KeyRange range = keyRangeOf(numbers);
  if (range.isEmpty()) return {};
  const KeyBuckets buckets(range);
  const Counts counts = countsOf(numbers, buckets);
  const uint64_t count = std::accumulate(counts.begin(), counts.end(), uint64_t{0});
  ASDFVK_CHECK_OP(shares.size(), <, size_t{kNoList});
  std::vector<Place> places;
  ListOfBucket listOf;
  listOf.fill(kNoList);
  uint8_t listCount = 0;
  for (const double share : shares) {
    places.push_back(placeOf(static_cast<uint64_t>(std::llround(share * static_cast<double>(count - 1))), counts));
    if (uint8_t& list = listOf[places.back().bucket]; list == kNoList) list = listCount++;
  }
  Lists lists = membersOf(listOf, listCount, numbers, buckets);
  std::vector<double> percentiles;
  for (const Place& place : places) {
    std::vector<double>& members = lists[listOf[place.bucket]];
    const auto found = members.begin() + static_cast<std::ptrdiff_t>(place.rank);
    std::nth_element(members.begin(), found, members.end());
    percentiles.push_back(*found);
  }
  return percentiles;
}

}  // namespace asdfvk
