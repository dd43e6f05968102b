#pragma once

#include "core/vec3.h"

namespace asdfvk {

/// The straight line between two points.
struct LineSegment {
  Vec3d from, to;
};

}  // namespace asdfvk
