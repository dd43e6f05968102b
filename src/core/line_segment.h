#pragma once

#include "core/vec3.h"

namespace asdfvk {

struct LineSegment {
  Vec3d from, to;
};

}  // namespace asdfvk
