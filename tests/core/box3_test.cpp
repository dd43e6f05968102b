#include "core/box3.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace asdfvk;

TEST_CASE("an empty box has no size and grows to the added points") {
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

TEST_CASE("a box of any size that the numbers hold has a finite centre, size and diagonal") {
  const auto cube = [](double half) {
    Box3d box;
    box.add(Vec3d{-half, -half, -half});
    box.add(Vec3d{half, half, half});
    return box;
  };
  for (const double half : {1e-170, 1e-160, 1.0, 1e160, 1e170}) {
    CAPTURE(half);
    CHECK(cube(half).diagonal() / half == doctest::Approx(2 * std::sqrt(3.0)));
  }
  const double largest = std::numeric_limits<double>::max();
  const Box3d all = cube(1.7e308);
  CHECK(all.centre() == Vec3d{});
  CHECK(all.halfSize() == Vec3d{1.7e308, 1.7e308, 1.7e308});
  CHECK(all.size() == Vec3d{largest, largest, largest});
  CHECK(all.diagonal() == largest);
  Box3d corner;
  corner.add(Vec3d{1.6e308, 1.6e308, 1.6e308});
  corner.add(Vec3d{1.7e308, 1.7e308, 1.7e308});
  CHECK(corner.centre().x == doctest::Approx(1.65e308));
  CHECK(corner.diagonal() == doctest::Approx(1e307 * std::sqrt(3.0)));
}
