// The boxes of the children of a wide node.
#include "shared/bvh_layout.h"

// Distances to the planes of four boxes on one axis. Bytes 0 to 2 are masked but not shifted; the scale corrects for
// that. Signed conversions are faster than unsigned ones.
vec4 distancesTo(uint bytes, float perByte, float start) {
  const vec4 planes = vec4(int(bytes & 0xffu), int(bytes & 0xff00u), int(bytes & 0xff0000u), int(bytes >> 24));
  return planes * (perByte * vec4(1.0, 1.0 / 256.0, 1.0 / 65536.0, 1.0)) + start;
}

// Sizes of a step of the bytes of a node.
vec3 stepsOf(DeviceWideNode node) {
  return uintBitsToFloat(uvec3(node.exponents << 23, node.exponents << 15, node.exponents << 7) & 0x7f800000u);
}
