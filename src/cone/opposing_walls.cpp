#include "cone/opposing_walls.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

// Added to the cosine of the angle from which walls oppose each other, so that walls at exactly this angle, such as
// those of a hexagonal prism at 120 degrees, do not depend on rounding: 0.07 degrees at 120 degrees, 2.6 at 180.
constexpr double kOpposingWallSlack = 1e-3;

}  // namespace

OpposingWalls makeOpposingWalls(double angleDegrees) {
  if (!(angleDegrees > 90 && angleDegrees <= 180))
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("an angle of {} degrees between opposing walls is out of range; give more than 90 and at "
                            "most 180",
                            angleDegrees));
  return {std::cos(angleDegrees * std::numbers::pi / 180) + kOpposingWallSlack};
}

}  // namespace asdfvk
