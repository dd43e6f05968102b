// The bounding volume hierarchy as a device reads it; included by C++ and by GLSL. Both arrays are arrays of 16-byte
// texels (format rgba32ui); floats travel as their bits. Coordinates are normalised, see Normalization.
//
//   node, 64 bytes                                       triangle, 48 bytes, in slot order
//   byte  0  leftMin.xyz   leftFirst    texel 0          byte  0  v0.xyz  faceIndex
//   byte 16  leftMax.xyz   leftCount    texel 1          byte 16  v1.xyz  0
//   byte 32  rightMin.xyz  rightFirst   texel 2          byte 32  v2.xyz  0
//   byte 48  rightMax.xyz  rightCount   texel 3
//
// A node holds its two children's boxes. Count 0: the child is an inner node and `first` is its index here; count > 0:
// the child is a leaf of triangle slots first .. first + count - 1. Node 0 is the root.
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

struct DeviceBvhNode {
  vec3 leftMin;
  uint leftFirst;
  vec3 leftMax;
  uint leftCount;
  vec3 rightMin;
  uint rightFirst;
  vec3 rightMax;
  uint rightCount;
};

struct DeviceTriangle {
  vec3 v0;
  uint faceIndex;
  vec3 v1;
  uint unused1;
  vec3 v2;
  uint unused2;
};

#ifdef __cplusplus
static_assert(sizeof(DeviceBvhNode) == 16 * kBvhNodeTexelCount);
static_assert(offsetof(DeviceBvhNode, leftMin) == 0 && offsetof(DeviceBvhNode, leftFirst) == 12);
static_assert(offsetof(DeviceBvhNode, leftMax) == 16 && offsetof(DeviceBvhNode, leftCount) == 28);
static_assert(offsetof(DeviceBvhNode, rightMin) == 32 && offsetof(DeviceBvhNode, rightFirst) == 44);
static_assert(offsetof(DeviceBvhNode, rightMax) == 48 && offsetof(DeviceBvhNode, rightCount) == 60);
static_assert(sizeof(DeviceTriangle) == 16 * kBvhTriangleTexelCount);
static_assert(offsetof(DeviceTriangle, v0) == 0 && offsetof(DeviceTriangle, faceIndex) == 12);
static_assert(offsetof(DeviceTriangle, v1) == 16 && offsetof(DeviceTriangle, unused1) == 28);
static_assert(offsetof(DeviceTriangle, v2) == 32 && offsetof(DeviceTriangle, unused2) == 44);
}  // namespace asdfvk
#else
DeviceBvhNode decodeBvhNode(uvec4 t0, uvec4 t1, uvec4 t2, uvec4 t3) {
  return DeviceBvhNode(uintBitsToFloat(t0.xyz), t0.w, uintBitsToFloat(t1.xyz), t1.w, uintBitsToFloat(t2.xyz), t2.w,
                       uintBitsToFloat(t3.xyz), t3.w);
}

DeviceTriangle decodeTriangle(uvec4 t0, uvec4 t1, uvec4 t2) {
  return DeviceTriangle(uintBitsToFloat(t0.xyz), t0.w, uintBitsToFloat(t1.xyz), t1.w, uintBitsToFloat(t2.xyz), t2.w);
}
#endif

#endif
