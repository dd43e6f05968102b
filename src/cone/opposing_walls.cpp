#include "cone/opposing_walls.h"

#include <cmath>
#include <numbers>

#include "core/check.h"

namespace asdfvk {
namespace {

// Added to the cosine of the angle between opposing walls. Because of this slack, walls at exactly this angle are
// opposing despite rounding, such as the walls of a hexagonal prism at 120 degrees. The slack is 0.07 degrees at 120
// and 2.6 at 180 degrees.
constexpr double kOpposingWallSlack = 1e-3;

}  // namespace

OpposingWalls makeOpposingWalls(const ThicknessOptions& options) {
  const double angleDegrees = options.wallAngleDegrees;
  ASDFVK_CHECK(angleDegrees > 90 && angleDegrees <= 180);
  return {std::cos(angleDegrees * std::numbers::pi / 180) + kOpposingWallSlack};
}

}  // namespace asdfvk
