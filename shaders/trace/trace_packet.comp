#version 450
// Packets (ASDF paper, section 6): the lanes of a subgroup traverse the hierarchy together. The lanes have the rays of
// one cone, or of several cones with few rays.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "wide_nodes.glsl"

// The nearest hits of all rays of the subgroup. The lanes share the stack and the current node. The lanes enter each
// node that any ray enters, in the order of the distances along the ray of the first lane. All loops are
// subgroup-uniform.
Hit findNearestHit(Query query) {
  const bvec3 isNegative = bvec3(subgroupBroadcastFirst(uvec3(query.isNegative)));
  const uint octantShift = octantShiftOf(isNegative);
  uint stackBases[kMaxBvhDepth];
  uint stackBits[kMaxBvhDepth];
  uint stackSize = 0u;
  Group group = Group(0u, 8u);
  Hit hit = Hit(kFarAway, kNoPrimitive, true);
  uint iterationCount = 0u;
  while (group.bits != 0u && iterationCount <= kIterationLimit) {
    const uint index = takeNearest(group, octantShift);
    if (hasMore(group)) {
      stackBases[stackSize] = group.base;
      stackBits[stackSize] = group.bits;
      ++stackSize;
    }
    const DeviceWideNode node = loadWideNode(index);
    // If the subgroup has diverged, another lane may be at another node. The mask keeps the children within range.
    const uint children = subgroupOr(enterChildren(node, query, hit.distance)) & node.childBits;
    const uint leaves = node.childBits & ~kWideInnerBits;
    uint triangles = children & leaves;
    group = groupOf(node, children, isNegative);
    if (group.bits == 0u && stackSize > 0u) {
      --stackSize;
      group = Group(stackBases[stackSize], stackBits[stackSize]);
    }
    iterationCount += 2u + bitCount(triangles);
    for (; triangles != 0u; triangles &= triangles - 1u) {
      const uint below = (triangles & (~triangles + 1u)) - 1u;
      testTriangle(query, node.triangleBase + bitCount(leaves & below), hit);
    }
  }
  hit.isComplete = iterationCount <= kIterationLimit;
  return hit;
}

#include "trace_main.glsl"
