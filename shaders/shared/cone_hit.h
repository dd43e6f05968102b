// What one ray of a cone met; included by C++ and by GLSL, which writes it as a uvec2 of the two fields' bits.
#ifndef ASDFVK_CONE_HIT_H
#define ASDFVK_CONE_HIT_H

#ifdef __cplusplus
#include <cstddef>

#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

const uint kNoFace = 0xffffffffu;            // The face of a ray that met nothing.
const uint kMissDistanceBits = 0x7f800000u;  // Its distance: infinity.

#ifdef __cplusplus
// 8 bytes.
struct ConeHit {
  float distance;  // In normalised units (Bvh::normalization).
  uint face;       // The one that stands for its copies, or kNoFace.
};
static_assert(sizeof(ConeHit) == 8);
static_assert(offsetof(ConeHit, distance) == 0 && offsetof(ConeHit, face) == 4);
}  // namespace asdfvk
#endif

#endif
