#include "core/percentiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

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

using IsWanted = std::array<bool, kBucketCount>;

/// The numbers in the wanted buckets.
std::vector<double> membersOf(const IsWanted& isWanted, std::span<const double> numbers, const KeyBuckets& buckets) {
  const auto collect = [&](size_t begin, size_t end) {
    std::vector<double> members;
    for (const double number : numbers.subspan(begin, end - begin))
      if (std::isfinite(number) && isWanted[buckets.of(number)]) members.push_back(number);
    return members;
  };
  return foldInParallel<std::vector<double>, kBlockSize>(
      numbers.size(), collect, [](std::vector<double> all, const std::vector<double>& further) {
        all.insert(all.end(), further.begin(), further.end());
        return all;
      });
}

/// Returns the bucket that contains the number with this rank. A rank is an index in ascending order.
size_t bucketOf(uint64_t rank, const Counts& counts) {
  size_t bucket = 0;
  for (; rank >= counts[bucket]; ++bucket) rank -= counts[bucket];
  return bucket;
}

}  // namespace

std::vector<double> percentilesOf(std::span<const double> numbers, std::span<const double> shares) {
  const KeyRange range = keyRangeOf(numbers);
  if (range.isEmpty()) return {};
  const KeyBuckets buckets(range);
  const Counts counts = countsOf(numbers, buckets);
  const uint64_t count = std::accumulate(counts.begin(), counts.end(), uint64_t{0});
  std::vector<uint64_t> ranks;
  IsWanted isWanted{};
  for (const double share : shares) {
    ranks.push_back(static_cast<uint64_t>(std::llround(share * static_cast<double>(count - 1))));
    isWanted[bucketOf(ranks.back(), counts)] = true;
  }
  std::vector<double> members = membersOf(isWanted, numbers, buckets);
  std::vector<double> percentiles;
  for (const uint64_t rank : ranks) {
    uint64_t place = rank;  // In ascending order of the members.
    for (size_t bucket = 0, end = bucketOf(rank, counts); bucket < end; ++bucket)
      if (!isWanted[bucket]) place -= counts[bucket];
    const auto found = members.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(members.begin(), found, members.end());
    percentiles.push_back(*found);
  }
  return percentiles;
}

}  // namespace asdfvk
