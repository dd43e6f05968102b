#include "core/short_sort.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/free_memory.h"
#include "core/random.h"
#include "core/unset_vector.h"

using namespace asdfvk;

TEST_CASE("short and long lists are sorted, also if many items are equal") {
  Random random(1);
  for (size_t size = 0; size <= 40; ++size)
    for (const uint64_t maximum : {0u, 1u, 5u, 1000u}) {
      CAPTURE(size);
      CAPTURE(maximum);
      std::vector<uint64_t> items(size);
      for (uint64_t& item : items) item = (random.next() >> 32) % (maximum + 1);
      std::vector<uint64_t> expected = items;
      std::sort(expected.begin(), expected.end());
      sortShortList(std::span(items));
      CHECK(items == expected);
    }
}

TEST_CASE("the memory of vectors is freed, unlike by the assignment of an empty list") {
  std::vector<int> numbers(1000);
  numbers = {};
  CHECK(numbers.capacity() == 1000);
  freeMemory(numbers);
  CHECK(numbers.capacity() == 0);
  UnsetVector<int> unset(1000);
  freeMemory(unset);
  CHECK(unset.capacity() == 0);
}
