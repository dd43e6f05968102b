// The nodes of the hierarchy of shared/bvh_layout.h, and their children in the order along a ray (Ylitie, Karras and
// Laine 2017).
#include "ray_query.glsl"

DeviceWideNode loadWideNode(uint index) {
  const uint t = index * kWideNodeTexelCount;
  return decodeWideNode(fetchNode(t), fetchNode(t + 1u), fetchNode(t + 2u), fetchNode(t + 3u), fetchNode(t + 4u));
}

// Moves nibble s to nibble s ^ octant, where the signs are the bits of the octant.
uint permuteNibbles(uint bits, bvec3 isNegative) {
  if (isNegative.x) bits = (bits & 0x0f0f0f0fu) << 4 | (bits >> 4 & 0x0f0f0f0fu);
  if (isNegative.y) bits = (bits & 0x00ff00ffu) << 8 | (bits >> 8 & 0x00ff00ffu);
  if (isNegative.z) bits = bits << 16 | bits >> 16;
  return bits;
}

// The exponent of a power of two below 2^31.
uint exponentOf(uint power) {
  if (kNodeArithmetic != kMaskedBytes) return uint(findLSB(power));
  return (floatBitsToUint(float(int(power))) >> 23) - 127u;
}

// The number of bits that are set. bits: at most the lowest bit of each nibble.
uint countNibbles(uint bits) {
  return kNodeArithmetic != kMaskedBytes ? uint(bitCount(bits)) : (bits * 0x11111111u) >> 28;
}

// Inner children of one node that are still to be entered. base: childBase of the node. bits: 0 if the ray enters no
// inner child. For each of these children, bit 4 p + 3 is set, where p = slot of the child ^ octant of the ray. The
// lowest such bit is the nearest child. If `bits` is not 0, bit 4 s + 2 is set for each slot s of the node with an
// inner child.
struct Group {
  uint base, bits;
};

Group groupOf(DeviceWideNode node, uint children, bvec3 isNegative) {
  const uint rest = permuteNibbles(children & kWideInnerBits, isNegative);
  return Group(node.childBase, rest == 0u ? 0u : rest | (node.childBits & kWideInnerBits) >> 1);
}

bool hasMore(Group group) { return (group.bits & kWideInnerBits) != 0u; }

// Removes the nearest child from a non-empty group. Returns its node.
uint takeNearest(inout Group group, uint octantShift) {
  const uint rest = (group.bits & kWideInnerBits) >> 3;
  const uint nearest = rest & (~rest + 1u);
  const uint below = (1u << (exponentOf(nearest) ^ octantShift)) - 1u;
  const uint rank = countNibbles(group.bits >> 2 & 0x11111111u & below);
  group.bits ^= nearest << 3;
  return group.base + rank;
}
