#include "core/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace asdfvk;

TEST_CASE("the generator yields the published numbers of SplitMix64") {
  Random random(0);
  CHECK(random.next() == 0xe220a8397b1dcdafu);
  CHECK(random.next() == 0x6e789e6aa1b965f4u);
  CHECK(random.next() == 0x06c45d188009454fu);
}

TEST_CASE("indices stay below the bound and reach all of it evenly") {
  Random random(7);
  for (uint32_t bound : {1u, 2u, 3u, 7u, 1000u}) {
    std::vector<uint32_t> counts(bound, 0);
    const uint32_t drawCount = 1000 * bound;
    for (uint32_t i = 0; i < drawCount; ++i) {
      const uint32_t index = random.index(bound);
      REQUIRE(index < bound);
      ++counts[index];
    }
    for (const uint32_t count : counts) {
      CHECK(count > 800);  // More than six standard deviations of slack.
      CHECK(count < 1200);
    }
  }
}

TEST_CASE("indices below a bound just over 2^31 are not biased to its lower part") {
  const uint32_t bound = 0x80000001u;  // A plain product or remainder would favour some values twofold.
  Random random(9);
  uint32_t lowCount = 0, evenCount = 0;
  for (int i = 0; i < 100000; ++i) {
    const uint32_t index = random.index(bound);
    REQUIRE(index < bound);
    lowCount += index < bound / 2;
    evenCount += index % 2 == 0;
  }
  CHECK(lowCount > 49000);
  CHECK(lowCount < 51000);
  CHECK(evenCount > 49000);
  CHECK(evenCount < 51000);
}

TEST_CASE("real numbers lie in [0, 1) around a half") {
  Random random(3);
  double sum = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = random.real();
    REQUIRE(value >= 0);
    REQUIRE(value < 1);
    sum += value;
  }
  CHECK(sum / 100000 == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("a shuffle is a permutation, the same for the same seed") {
  std::vector<int> sorted(1000);
  std::iota(sorted.begin(), sorted.end(), 0);
  const auto shuffled = [&](uint64_t seed) {
    std::vector<int> items = sorted;
    Random(seed).shuffle(std::span<int>(items));
    return items;
  };
  std::vector<int> items = shuffled(1);
  CHECK(items == shuffled(1));
  CHECK(items != shuffled(2));
  CHECK(items != sorted);
  std::sort(items.begin(), items.end());
  CHECK(items == sorted);
}

TEST_CASE("a shuffle reaches every order of three items equally often") {
  std::vector<int> counts(27, 0);
  Random random(5);
  for (int i = 0; i < 60000; ++i) {
    std::vector<int> items{0, 1, 2};
    random.shuffle(std::span<int>(items));
    ++counts[static_cast<size_t>(items[0] * 9 + items[1] * 3 + items[2])];
  }
  int reachedCount = 0;
  for (const int count : counts) {
    if (count == 0) continue;
    ++reachedCount;
    CHECK(count > 9400);
    CHECK(count < 10600);
  }
  CHECK(reachedCount == 6);
}

TEST_CASE("shuffling nothing or one item is allowed") {
  Random random(1);
  std::vector<int> none, one{4};
  random.shuffle(std::span<int>(none));
  random.shuffle(std::span<int>(one));
  CHECK(one == std::vector<int>{4});
}
