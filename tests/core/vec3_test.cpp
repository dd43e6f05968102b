#include "core/vec3.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>

using namespace asdfvk;

TEST_CASE("vectors add, scale and multiply as geometry has it") {
  const Vec3d a{1, 2, 3}, b{4, -5, 6};
  CHECK(a + b == Vec3d{5, -3, 9});
  CHECK(a - b == Vec3d{-3, 7, -3});
  CHECK(-a == Vec3d{-1, -2, -3});
  CHECK(2.0 * a == a + a);
  CHECK(a / 2.0 == Vec3d{0.5, 1, 1.5});
  CHECK(dot(a, b) == 12);
  CHECK(cross(a, b) == Vec3d{27, 6, -13});
  CHECK(length(Vec3d{2, 3, 6}) == 7);
}

TEST_CASE("coordinates are indexed by axis and converted on demand") {
  Vec3d a{1, 2, 3};
  a[1] = 7;
  CHECK(a[0] == 1);
  CHECK(a[1] == 7);
  CHECK(a[2] == 3);
  CHECK(static_cast<Vec3f>(a) == Vec3f{1, 7, 3});
}

TEST_CASE("a vector is finite only when all its coordinates are") {
  CHECK(isFinite(Vec3d{1, 2, 3}));
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
      Vec3d a{1, 2, 3};
      a[axis] = bad;
      CHECK_FALSE(isFinite(a));
    }
  }
}
