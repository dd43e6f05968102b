#include "core/radix_sort.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>

#include "core/random.h"

using namespace asdfvk;

TEST_CASE("items are sorted by key, and equal keys keep their order") {
  struct Item {
    uint32_t key, index;
    bool operator==(const Item&) const = default;
  };
  Random random(1);
  for (const uint32_t maxKey : {0u, 1u, 5u, 2047u, 2048u, 100'000u, 0x7fff'ffffu, 0xffff'ffffu}) {
    for (const uint32_t count : {0u, 1u, 1000u, 100'000u}) {
      CAPTURE(maxKey);
      CAPTURE(count);
      UnsetVector<Item> items;
      for (uint32_t i = 0; i < count; ++i) {
        const uint64_t key = random.next() >> 32;
        items.push_back({static_cast<uint32_t>(key % (uint64_t{maxKey} + 1)), i});
      }
      if (count > 0) items[count / 2].key = maxKey;
      UnsetVector<Item> expected = items;
      std::stable_sort(expected.begin(), expected.end(), [](const Item& a, const Item& b) { return a.key < b.key; });
      sortByKey(items, maxKey, [](const Item& item) { return item.key; });
      CHECK(items == expected);
    }
  }
}
