#ifndef ASDFVK_CONE_LAYOUT_H
#define ASDFVK_CONE_LAYOUT_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
using glsl::vec3;
#endif

const uint kConeOriginTexelCount = 3u;

// The start of a cone, 48 bytes, in normalised coordinates. Kernels read the start as texels of 16 bytes (format
// rgba32ui). The axis of the frame is cross(tangent, bitangent).
struct ConeOrigin {
  vec3 origin;
  uint excludedFace;  // The representative of the seed face; hits on this face are ignored.
  vec3 tangent;
  uint unused0;
  vec3 bitangent;
  uint unused1;
};

// The seed of a cone, 8 bytes. cone_origins.comp computes the start of the cone from the seed.
struct ConeSeed {
  uint triangle;   // Index in the order of the hierarchy, with kFlippedFrameBit.
  float halfTurn;  // tan(angle / 2) of the rotation of the frame about its axis, coneRotation().
};

// Set in ConeSeed::triangle if coneFrame() in src/cone/cone.h uses its first case. The host decides the case, so that
// rounding on the device does not select another frame.
const uint kFlippedFrameBit = 0x40000000u;

// One ray of every cone, 16 bytes and one texel, in the frame of the cone.
struct ConeRay {
  vec3 direction;
  float weight;
};

struct ConePush {
  uint coneCount;
  float falseHitCosine;     // See Cone in src/cone/cone.h.
  float outlierDeviations;  // Cone::outliers.
  float contactDistance;    // See Cone.
};

// A result is the bits of a length in normalised units, or one of these constants.
const uint kNoValueBits = 0x7fc00000u;         // No valid ray: a quiet NaN.
const uint kIterationLimitBits = 0x7fc00001u;  // The iteration limit stopped the cone: the reference traces the cone.

#ifdef __cplusplus
static_assert(sizeof(ConeOrigin) == 48);
static_assert(sizeof(ConeSeed) == 8);
static_assert(sizeof(ConeRay) == 16);
static_assert(sizeof(ConePush) == 16);
}  // namespace asdfvk
#else
ConeOrigin decodeConeOrigin(uvec4 t0, uvec4 t1, uvec4 t2) {
  return ConeOrigin(uintBitsToFloat(t0.xyz), t0.w, uintBitsToFloat(t1.xyz), t1.w, uintBitsToFloat(t2.xyz), t2.w);
}

ConeRay decodeConeRay(uvec4 t0) { return ConeRay(uintBitsToFloat(t0.xyz), uintBitsToFloat(t0.w)); }
#endif

#endif
