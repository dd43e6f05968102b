#include "core/box3.h"

#include <doctest/doctest.h>

using namespace asdfvk;

TEST_CASE("an empty box has no size and takes on what is added") {
  Box3d box;
  CHECK(box.isEmpty());
  CHECK(box.size() == Vec3d{});
  CHECK(box.centre() == Vec3d{});
  CHECK(box.diagonal() == 0);
  box.add(Vec3d{1, 2, 3});
  CHECK_FALSE(box.isEmpty());
  CHECK(box.centre() == Vec3d{1, 2, 3});
  CHECK(box.diagonal() == 0);
  box.add(Box3d{});
  CHECK(box.max == Vec3d{1, 2, 3});
}

TEST_CASE("a box grows by points and boxes") {
  Box3d box, other;
  box.add(Vec3d{0, 0, 0});
  other.add(Vec3d{-1, 1, 2});
  other.add(Vec3d{0, 2, -4});
  box.add(other);
  CHECK(box.min == Vec3d{-1, 0, -4});
  CHECK(box.max == Vec3d{0, 2, 2});
  CHECK(box.size() == Vec3d{1, 2, 6});
  CHECK(box.centre() == Vec3d{-0.5, 1, -1});
  CHECK(box.halfArea() == 1 * 2 + 2 * 6 + 6 * 1);
  CHECK(box.diagonal() == doctest::Approx(std::sqrt(41.0)));
}
