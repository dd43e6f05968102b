#include "core/counted.h"

#include <doctest/doctest.h>

using namespace asdfvk;

TEST_CASE("one thing is told in the singular, all other numbers in the plural") {
  CHECK(counted(0, "face") == "0 faces");
  CHECK(counted(1, "face") == "1 face");
  CHECK(counted(2, "face") == "2 faces");
  CHECK(counted(1, "vertex", "vertices") == "1 vertex");
  CHECK(counted(21, "vertex", "vertices") == "21 vertices");
}
