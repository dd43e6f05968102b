#include "core/index_table.h"

#include <doctest/doctest.h>

#include <map>

#include "core/random.h"

using namespace asdfvk;

TEST_CASE("a table has the entries of a map, while it grows and after it was cleared") {
  IndexTable<uint32_t> table;
  Random random(1);
  for (const uint32_t bound : {1000u, 4'000'000'000u, 10u}) {
    table.clear();
    std::map<uint32_t, uint32_t> expected;
    for (uint32_t i = 0; i < 3000; ++i) {
      const auto index = random.index(bound);
      const bool isNew = expected.emplace(index, i).second;
      const auto added = table.add(index);
      CHECK(added.second == isNew);
      CHECK(added.first.index == index);
      if (isNew) added.first.value = i;
    }
    for (const auto& [index, value] : expected) CHECK(table[index] == value);
  }
}

TEST_CASE("a new entry has the default value, also where an earlier entry was") {
  IndexTable<int> table;
  table.add(7).first.value = 5;
  CHECK(table[7] == 5);
  table.clear();
  CHECK(table.add(7).first.value == 0);
  table.resetFor(3);
  CHECK(table.add(7).second);
}

TEST_CASE("entries stay in their places up to the count that the table was reset for") {
  IndexTable<int> table;
  table.resetFor(1024);
  const auto* const first = &table.add(0).first;
  for (uint32_t index = 1; index < 1024; ++index) table.add(index);
  CHECK(&table.add(0).first == first);
}
