// The hit of one ray of a cone. GLSL writes a hit as a uvec2 of the bits of both fields.
#ifndef ASDFVK_CONE_HIT_H
#define ASDFVK_CONE_HIT_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

const uint kNoFace = 0xffffffffu;            // The face of a ray without a hit.
const uint kMissDistanceBits = 0x7f800000u;  // The distance of a ray without a hit: infinity.

#ifdef __cplusplus
// 8 bytes.
struct ConeHit {
  float distance;  // In normalised units (Bvh::normalization).
  uint face;       // Representative of its coincident faces, or kNoFace.
};
static_assert(sizeof(ConeHit) == 8);
}  // namespace asdfvk
#endif

#endif
