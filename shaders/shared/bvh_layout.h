// The bounding volume hierarchy as a device reads it; included by C++ and by GLSL. Both arrays are arrays of 16-byte
// texels (format rgba32ui); floats travel as their bits. Coordinates are normalised, see Normalization.
//
//   node, 64 bytes                                       triangle, 48 bytes, in slot order
//   byte  0  leftMin.xyz   left         texel 0          byte  0  v0.xyz  faceIndex
//   byte 16  leftMax.xyz   unused       texel 1          byte 16  v1.xyz  normalU
//   byte 32  rightMin.xyz  right        texel 2          byte 32  v2.xyz  normalV
//   byte 48  rightMax.xyz  unused       texel 3
//
// A node holds its two children's boxes and a reference to each: an inner child is its node's index, a leaf is its first
// triangle slot with the count of its triangles (1 to kMaxLeafTriangleCount) above kReferenceCountShift. Node 0 is the
// root. The normal is the one of the double-precision mesh, octahedrally encoded (Cigolle et al. 2014): that of the
// rounded corners would be noise on small faces.
#ifndef ASDFVK_BVH_LAYOUT_H
#define ASDFVK_BVH_LAYOUT_H

#ifdef __cplusplus
#include <cstddef>

#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
using glsl::vec3;
#endif

const uint kBvhNodeTexelCount = 4u;
const uint kBvhTriangleTexelCount = 3u;

// Deepest hierarchy that a traversal stack has room for; the builder splits at the median where SAH would go deeper.
const uint kMaxBvhDepth = 48u;

const uint kReferenceCountShift = 28u;
const uint kReferenceFirstMask = 0x0fffffffu;
const uint kMaxLeafTriangleCount = 14u;  // So that no reference looks like kNoReference.
const uint kNoReference = 0xffffffffu;

struct DeviceBvhNode {
  vec3 leftMin;
  uint left;
  vec3 leftMax;
  uint unused0;
  vec3 rightMin;
  uint right;
  vec3 rightMax;
  uint unused1;
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
static_assert(sizeof(DeviceBvhNode) == 16 * kBvhNodeTexelCount);
static_assert(offsetof(DeviceBvhNode, leftMin) == 0 && offsetof(DeviceBvhNode, left) == 12);
static_assert(offsetof(DeviceBvhNode, leftMax) == 16 && offsetof(DeviceBvhNode, unused0) == 28);
static_assert(offsetof(DeviceBvhNode, rightMin) == 32 && offsetof(DeviceBvhNode, right) == 44);
static_assert(offsetof(DeviceBvhNode, rightMax) == 48 && offsetof(DeviceBvhNode, unused1) == 60);
static_assert(sizeof(DeviceTriangle) == 16 * kBvhTriangleTexelCount);
static_assert(offsetof(DeviceTriangle, v0) == 0 && offsetof(DeviceTriangle, faceIndex) == 12);
static_assert(offsetof(DeviceTriangle, v1) == 16 && offsetof(DeviceTriangle, normalU) == 28);
static_assert(offsetof(DeviceTriangle, v2) == 32 && offsetof(DeviceTriangle, normalV) == 44);
}  // namespace asdfvk
#else
DeviceBvhNode decodeBvhNode(uvec4 t0, uvec4 t1, uvec4 t2, uvec4 t3) {
  return DeviceBvhNode(uintBitsToFloat(t0.xyz), t0.w, uintBitsToFloat(t1.xyz), t1.w, uintBitsToFloat(t2.xyz), t2.w,
                       uintBitsToFloat(t3.xyz), t3.w);
}

DeviceTriangle decodeTriangle(uvec4 t0, uvec4 t1, uvec4 t2) {
  return DeviceTriangle(uintBitsToFloat(t0.xyz), t0.w, uintBitsToFloat(t1.xyz), uintBitsToFloat(t1.w),
                        uintBitsToFloat(t2.xyz), uintBitsToFloat(t2.w));
}

vec3 decodeNormal(float u, float v) {
  const float z = 1.0 - abs(u) - abs(v);
  const float fold = max(-z, 0.0);
  return normalize(vec3(u - (u < 0.0 ? -fold : fold), v - (v < 0.0 ? -fold : fold), z));
}
#endif

#endif
