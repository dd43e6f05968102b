#version 450
// A ray per lane: each lane traverses the hierarchy independently.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#include "shared/specialization_ids.h"

#include "wide_nodes.glsl"

// See VulkanWalkShape in src/trace/vk/vulkan_trace_choice.h. The default values also work.
layout(constant_id = kStackSizeId) const uint kStackSize = kMaxBvhDepth;
layout(constant_id = kPostponesTrianglesId) const bool kPostponesTriangles = true;

// Triangles of one node that are still to be tested. bits: these triangles. all: all triangles of the node. Both are
// nibbles as in DeviceWideNode::childBits. base: triangleBase of the node.
struct Leaves {
  uint base, bits, all;
};

const Leaves kNoLeaves = Leaves(0u, 0u, 0u);

// Postponed triangles; entries after an empty entry are empty. Without kPostponesTriangles, only the first entry is
// used.
struct LeafQueue {
  Leaves first, second, third;
};

void add(inout LeafQueue queue, Leaves leaves) {
  if (leaves.bits == 0u) return;
  if (!kPostponesTriangles || queue.first.bits == 0u) {
    queue.first = leaves;
  } else if (queue.second.bits == 0u) {
    queue.second = leaves;
  } else {
    queue.third = leaves;
  }
}

// Removes a primitive and returns it; returns `otherwise` if the queue is empty.
uint takePrimitive(inout LeafQueue queue, uint otherwise) {
  const uint lowest = queue.first.bits & (~queue.first.bits + 1u);
  const uint primitive = queue.first.base + bitCount(queue.first.all & (lowest - 1u));
  queue.first.bits ^= lowest;
  if (kPostponesTriangles && queue.first.bits == 0u) {
    queue.first = queue.second;
    queue.second = queue.third;
    queue.third.bits = 0u;
  }
  return lowest == 0u ? otherwise : primitive;
}

// With kPostponesTriangles, tests of triangles are postponed until a lane of the subgroup has triangles of three nodes.
// Tests after each node would leave most lanes idle while a few lanes test triangles. Two triangles are tested at a
// time, which hides the latency of loading them. Without kPostponesTriangles, a lane with triangles waits for the other
// lanes of the subgroup, until each has triangles or no node left (Aila and Laine 2009). The second way needs fewer
// registers, but more steps (docs/devices.md).
Hit findNearestHit(Query query) {
  uint stackBases[kStackSize];
  uint stackBits[kStackSize];
  uint stackSize = 0u;
  Group group = Group(0u, 8u);  // The root.
  LeafQueue queue = LeafQueue(kNoLeaves, kNoLeaves, kNoLeaves);
  Hit hit = Hit(kFarAway, kNoPrimitive, true);
  uint iterationCount = 0u;

  while (group.bits != 0u) {
    while (group.bits != 0u) {
      const uint index = takeNearest(group, query.octantShift);
      if (hasMore(group)) {
        stackBases[stackSize] = group.base;
        stackBits[stackSize] = group.bits;
        ++stackSize;
      }
      const DeviceWideNode node = loadWideNode(index);
      const uint children = enterChildren(node, query, hit.distance);
      group = groupOf(node, children, query.isNegative);
      if (group.bits == 0u && stackSize > 0u) {
        --stackSize;
        group = Group(stackBases[stackSize], stackBits[stackSize]);
      }
      add(queue, Leaves(node.triangleBase, children & ~kWideInnerBits, node.childBits & ~kWideInnerBits));
      if (++iterationCount > kIterationLimit) group.bits = 0u;
      if (kPostponesTriangles ? subgroupAny(queue.third.bits != 0u) : queue.first.bits != 0u) break;
    }
    while (queue.first.bits != 0u) {
      const uint primitive = takePrimitive(queue, kNoPrimitive);
      if (kPostponesTriangles) {
        testTriangles(query, primitive, takePrimitive(queue, primitive), hit);
      } else {
        testTriangle(query, primitive, hit);
      }
      ++iterationCount;
    }
    iterationCount += 3u;  // One iteration of this loop, and the entries of the two inner loops.
  }
  hit.isComplete = iterationCount <= kIterationLimit;
  return hit;
}

#include "trace_main.glsl"
