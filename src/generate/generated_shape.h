#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// A closed, manifold triangle mesh, outward by the right-hand rule, and what is known of it by construction.
struct GeneratedShape {
  Mesh mesh;
  std::vector<uint32_t> part;   ///< #F, the part that the face belongs to; 0 where a shape has one part only.
  std::vector<float> diameter;  ///< #F, the true local diameter of the shape beneath the face, in the mesh's unit.
};

/// The face counts that a generator can be asked for. What it makes is within about 15 % of the wish, below some
/// hundred faces as near as the shape allows.
inline constexpr uint64_t kMinFaceCount = 20;
inline constexpr uint64_t kMaxFaceCount = 50'000'000;

/// Gives every face part 0 and the same diameter.
[[nodiscard]] GeneratedShape withUniformDiameter(Mesh mesh, double diameter);

}  // namespace asdfvk
