#include "core/free_memory.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/unset_vector.h"

using namespace asdfvk;

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
