#pragma once

#include <array>
#include <cstdint>

#include "core/vec3.h"

namespace asdfvk {

struct Icosahedron {
  std::array<Vec3d, 12> vertices;                 ///< On the unit sphere.
  std::array<std::array<uint32_t, 3>, 20> faces;  ///< Counter-clockwise seen from outside.
};

[[nodiscard]] Icosahedron unitIcosahedron();

}  // namespace asdfvk
