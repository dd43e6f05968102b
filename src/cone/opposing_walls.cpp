#include "cone/opposing_walls.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "asdf_vk/error.h"
#include "shared/cone_rules.h"

namespace asdfvk {

OpposingWalls makeOpposingWalls(double angleDegrees) {
  if (!(angleDegrees > 90 && angleDegrees <= 180))
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("an angle of {} degrees between opposing walls is out of range; give more than 90 and at "
                            "most 180",
                            angleDegrees));
  return {std::cos(angleDegrees * std::numbers::pi / 180) + static_cast<double>(kOpposingWallSlack)};
}

}  // namespace asdfvk
