#include "cone/opposing_walls.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/check.h"

using namespace asdfvk;

TEST_CASE("walls oppose from the angle on, with a slack for rounding") {
  constexpr Vec3d axis{0, 0, 1};
  const OpposingWalls walls = makeOpposingWalls({120});
  const auto at = [](double degrees) {
    const double radians = degrees * std::acos(-1.0) / 180;
    return Vec3d{std::sin(radians), 0, std::cos(radians)};
  };
  CHECK(walls.contain(axis, at(180)));
  CHECK(walls.contain(axis, at(120)));
  CHECK_FALSE(walls.contain(axis, at(119)));
  CHECK_FALSE(walls.contain(axis, at(90)));
  CHECK(makeOpposingWalls({180}).contain(axis, at(180)));
  for (const double wrong : {90.0, 180.5, 0.0, std::nan("")})
    CHECK_THROWS_AS((void)makeOpposingWalls({wrong}), CheckFailure);
}
