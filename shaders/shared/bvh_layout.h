// Layout of the bounding volume hierarchy on a device. Both arrays consist of 16-byte texels (format rgba32ui); floats
// are stored as their bits. Coordinates are normalised, see Normalization.
//
//   node, 80 bytes, of up to eight children (after Ylitie, Karras and Laine 2017)
//   byte  0  origin.xyz  exponents                            texel 0
//   byte 16  childBase  triangleBase  childBits  unused       texel 1
//   byte 32  x: lower[0-3] lower[4-7] upper[0-3] upper[4-7]   texel 2
//   byte 48  y: the same                                      texel 3
//   byte 64  z: the same                                      texel 4
//
// Node 0 is the root. On each axis the box of the child in slot s spans origin + lower[s] * scale to origin + upper[s]
// * scale. lower[s] and upper[s] are bytes. `scale` is a power of two; its biased exponent is byte 0 (x), 1 (y) or 2
// (z) of `exponents`. Nibble s of childBits is the kind of the child: 8 an inner child; 1, 3 or 7 a leaf with one, two
// or three triangles; 0 no child. The inner children have consecutive node indices from childBase on, in the order of
// the slots. Likewise, the triangles of leaves have consecutive indices from triangleBase on. Slots are assigned so
// that a ray whose direction has the sign bits q (x in bit 0) hits the children approximately in the order of slot ^ q.
//
//   triangle, 48 bytes, in primitive order
//   byte  0  v0.xyz  faceIndex                                texel 0
//   byte 16  v1.xyz  normalU                                  texel 1
//   byte 32  v2.xyz  normalV                                  texel 2
//
// normalU and normalV are the octahedral encoding of the normal (Cigolle et al. 2014) of the double-precision mesh. On
// small faces, the normal of the rounded corners would be noise.
#ifndef ASDFVK_BVH_LAYOUT_H
#define ASDFVK_BVH_LAYOUT_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
using glsl::uvec4;
using glsl::vec3;
#endif

const uint kWideNodeTexelCount = 5u;
const uint kBvhTriangleTexelCount = 3u;

// Capacity of a traversal stack, in levels. If SAH splits would exceed the capacity, the builder splits at the median.
const uint kMaxBvhDepth = 48u;

const uint kWideChildCount = 8u;
const uint kMaxWideLeafTriangleCount = 3u;
const uint kWideInnerBits = 0x88888888u;

struct DeviceWideNode {
  vec3 origin;
  uint exponents;
  uint childBase;
  uint triangleBase;
  uint childBits;
  uint unused;
  uvec4 x;
  uvec4 y;
  uvec4 z;
};

struct DeviceTriangle {
  vec3 v0;
  uint faceIndex;
  vec3 v1;
  float normalU;
  vec3 v2;
  float normalV;
};

#ifdef __cplusplus
static_assert(sizeof(DeviceWideNode) == 16 * kWideNodeTexelCount);
static_assert(sizeof(DeviceTriangle) == 16 * kBvhTriangleTexelCount);
}  // namespace asdfvk
#else
DeviceWideNode decodeWideNode(uvec4 t0, uvec4 t1, uvec4 t2, uvec4 t3, uvec4 t4) {
  return DeviceWideNode(uintBitsToFloat(t0.xyz), t0.w, t1.x, t1.y, t1.z, t1.w, t2, t3, t4);
}

DeviceTriangle decodeTriangle(uvec4 t0, uvec4 t1, uvec4 t2) {
  return DeviceTriangle(uintBitsToFloat(t0.xyz), t0.w, uintBitsToFloat(t1.xyz), uintBitsToFloat(t1.w),
                        uintBitsToFloat(t2.xyz), uintBitsToFloat(t2.w));
}

// Returns a vector parallel to the normal, with a length between 1 / sqrt(3) and 1.
vec3 octahedralDirection(float u, float v) {
  const float z = 1.0 - abs(u) - abs(v);
  const float fold = max(-z, 0.0);
  return vec3(u - (u < 0.0 ? -fold : fold), v - (v < 0.0 ? -fold : fold), z);
}

vec3 decodeNormal(float u, float v) { return normalize(octahedralDirection(u, v)); }
#endif

#endif
