#include "core/parallel.h"

#include <doctest/doctest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace asdfvk;

TEST_CASE("selected items keep their order, for any number of items") {
  for (const size_t count : {size_t{0}, size_t{1}, 4 * kItemsPerTask - 1, 4 * kItemsPerTask, 12 * kItemsPerTask + 1}) {
    CAPTURE(count);
    for (const uint32_t divisor : {1u, 2u, 3u, 1'000'000'007u}) {
      std::vector<uint32_t> expected, items, expectedItems;
      for (uint32_t i = 0; i < count; ++i) {
        items.push_back(7 * i);
        if (i % divisor == 0) expected.push_back(i);
        if (7 * i % divisor == 0) expectedItems.push_back(7 * i);
      }
      const auto holds = [divisor](uint32_t i) { return i % divisor == 0; };
      CHECK(indicesInParallel(count, holds) == expected);
      CHECK(selectInParallel(items, holds) == expectedItems);
    }
  }
  CHECK(indicesInParallel(100'000, [](uint32_t) { return false; }).empty());
}

TEST_CASE("values of blocks are joined in ascending order") {
  const auto nameOf = [](size_t begin, size_t) { return std::to_string(begin / 10) + " "; };
  CHECK(foldInParallel<std::string, 10>(35, nameOf, std::plus<>()) == "0 1 2 3 ");
}

TEST_CASE("items are used in their order while later items are made, each in a slot of its own") {
  for (const size_t slotCount : {1, 3, 40})
    for (const size_t count : {0, 1, 100}) {
      CAPTURE(slotCount);
      std::vector<size_t> slots(slotCount, count), used;  // The item in each slot, or `count`.
      std::atomic<size_t> wrongCount = 0;
      forEachInOrder(
          count, slotCount,
          [&](size_t item, size_t slot) {
            if (std::exchange(slots[slot], item) != count) ++wrongCount;
          },
          [&](size_t item, size_t slot) {
            if (std::exchange(slots[slot], count) != item) ++wrongCount;
            used.push_back(item);
          });
      std::vector<size_t> expected(count);
      std::iota(expected.begin(), expected.end(), size_t{0});
      CHECK(used == expected);
      CHECK(wrongCount == 0);
    }
}

TEST_CASE("an exception of a use ends the loop") {
  size_t usedCount = 0;
  const auto use = [&](size_t, size_t) {
    if (++usedCount == 5) throw std::runtime_error("full");
  };
  CHECK_THROWS_WITH(forEachInOrder(
                        1000, 4, [](size_t, size_t) {}, use),
                    "full");
  CHECK(usedCount == 5);
}
