#include "core/parallel.h"

#include <doctest/doctest.h>

#include <numeric>
#include <string>

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
