// Nearest hit of one ray in the wide hierarchy of shared/bvh_layout.h (Ylitie, Karras and Laine 2017).
#extension GL_KHR_shader_subgroup_vote : require

DeviceWideNode loadWideNode(uint index) {
  const uint t = index * kWideNodeTexelCount;
  return decodeWideNode(fetchNode(t), fetchNode(t + 1u), fetchNode(t + 2u), fetchNode(t + 3u), fetchNode(t + 4u));
}

// Distances to the planes of four boxes on one axis. Bytes 0 to 2 are masked but not shifted; the scale corrects for
// that. Signed conversions are faster than unsigned ones.
vec4 distancesTo(uint bytes, float perByte, float start) {
  const vec4 planes = vec4(int(bytes & 0xffu), int(bytes & 0xff00u), int(bytes & 0xff0000u), int(bytes >> 24));
  return planes * (perByte * vec4(1.0, 1.0 / 256.0, 1.0 / 65536.0, 1.0)) + start;
}

// A nibble of ones for each of the four boxes that the ray enters before `limit`. Distances are compared as integers,
// by their bits: the order of non-negative floats, and the reverse order of negative floats. All distances of a box
// behind the origin are negative: by bits its exit is below its entry, so it is not entered. A minimum of floats takes
// three instructions on llvmpipe because of NaNs, which do not occur here. kWideBoxMargin includes the margin for
// rounding.
uint enterBoxes(uvec3 near, uvec3 far, vec3 perByte, vec3 start, float limit) {
  const vec4 nearX = distancesTo(near.x, perByte.x, start.x), farX = distancesTo(far.x, perByte.x, start.x);
  const vec4 nearY = distancesTo(near.y, perByte.y, start.y), farY = distancesTo(far.y, perByte.y, start.y);
  const vec4 nearZ = distancesTo(near.z, perByte.z, start.z), farZ = distancesTo(far.z, perByte.z, start.z);
  const ivec4 enter = max(max(floatBitsToInt(nearX), floatBitsToInt(nearY)), floatBitsToInt(nearZ));
  const ivec4 inside = min(min(floatBitsToInt(farX), floatBitsToInt(farY)), floatBitsToInt(farZ));
  const ivec4 leave = min(inside, ivec4(floatBitsToInt(limit)));
  return (enter.x <= leave.x ? 0xfu : 0u) | (enter.y <= leave.y ? 0xf0u : 0u) | (enter.z <= leave.z ? 0xf00u : 0u) |
         (enter.w <= leave.w ? 0xf000u : 0u);
}

// Moves nibble s to s ^ the octant of the signs.
uint permuteNibbles(uint bits, bvec3 isNegative) {
  if (isNegative.x) bits = (bits & 0x0f0f0f0fu) << 4 | (bits >> 4 & 0x0f0f0f0fu);
  if (isNegative.y) bits = (bits & 0x00ff00ffu) << 8 | (bits >> 8 & 0x00ff00ffu);
  if (isNegative.z) bits = bits << 16 | bits >> 16;
  return bits;
}

// The exponent of a power of two below 2^31.
uint exponentOf(uint power) { return (floatBitsToUint(float(int(power))) >> 23) - 127u; }

// A ray prepared for the traversal.
struct WideRay {
  vec3 origin, inverseDirection;
  bvec3 isNegative;  // Of the direction.
};

WideRay makeWideRay(vec3 origin, vec3 direction) {
  return WideRay(origin, invert(direction), lessThan(direction, vec3(0.0)));
}

// The nibbles of childBits of the children that the ray enters before `limit`; the other nibbles are 0.
uint enterChildren(DeviceWideNode node, WideRay ray, float limit) {
  const uvec3 exponents = uvec3(node.exponents << 23, node.exponents << 15, node.exponents << 7) & 0x7f800000u;
  const vec3 perByte = uintBitsToFloat(exponents) * ray.inverseDirection;
  const vec3 start = (node.origin - ray.origin) * ray.inverseDirection;
  const uvec4 x = ray.isNegative.x ? node.x.zwxy : node.x;
  const uvec4 y = ray.isNegative.y ? node.y.zwxy : node.y;
  const uvec4 z = ray.isNegative.z ? node.z.zwxy : node.z;
  return (enterBoxes(uvec3(x.x, y.x, z.x), uvec3(x.z, y.z, z.z), perByte, start, limit) |
          enterBoxes(uvec3(x.y, y.y, z.y), uvec3(x.w, y.w, z.w), perByte, start, limit) << 16) &
         node.childBits;
}

// Inner children of one node that are still to be entered. `base` is the childBase of the node. `bits` has bit 4 p + 3
// for each of them, p = its slot ^ the octant of the ray, so that the lowest bit is the nearest child, and bit 4 s + 2
// for each slot s of the node with an inner child. `bits` is 0 if the ray enters none of them.
struct Group {
  uint base, bits;
};

Group groupOf(DeviceWideNode node, uint children, bvec3 isNegative) {
  const uint rest = permuteNibbles(children & kWideInnerBits, isNegative);
  return Group(node.childBase, rest == 0u ? 0u : rest | (node.childBits & kWideInnerBits) >> 1);
}

bool hasMore(Group group) { return (group.bits & kWideInnerBits) != 0u; }

// Removes the nearest child from a non-empty group and returns its node.
uint takeNearest(inout Group group, bvec3 isNegative) {
  const uint rest = (group.bits & kWideInnerBits) >> 3;
  const uint nearest = rest & (~rest + 1u);
  const uvec3 signBits = uvec3(isNegative);
  const uint octantShift = signBits.x << 2 | signBits.y << 3 | signBits.z << 4;
  const uint below = (1u << (exponentOf(nearest) ^ octantShift)) - 1u;
  const uint rank = ((group.bits >> 2 & 0x11111111u & below) * 0x11111111u) >> 28;
  group.bits ^= nearest << 3;
  return group.base + rank;
}

// Triangles of one node that are still to be tested. `bits` marks them, `all` marks all triangles of the node, both in
// the nibbles of DeviceWideNode::childBits; `base` is the triangleBase of the node.
struct Leaves {
  uint base, bits, all;
};

const Leaves kNoLeaves = Leaves(0u, 0u, 0u);

// Postponed triangles; an empty entry is followed by empty ones only.
struct LeafQueue {
  Leaves first, second, third;
};

void add(inout LeafQueue queue, Leaves leaves) {
  if (leaves.bits == 0u) return;
  if (queue.first.bits == 0u) {
    queue.first = leaves;
  } else if (queue.second.bits == 0u) {
    queue.second = leaves;
  } else {
    queue.third = leaves;
  }
}

// Removes and returns a primitive; returns `otherwise` if the queue is empty.
uint takePrimitive(inout LeafQueue queue, uint otherwise) {
  const uint lowest = queue.first.bits & (~queue.first.bits + 1u);
  const uint primitive = queue.first.base + bitCount(queue.first.all & (lowest - 1u));
  queue.first.bits ^= lowest;
  if (queue.first.bits == 0u) {
    queue.first = queue.second;
    queue.second = queue.third;
    queue.third.bits = 0u;
  }
  return lowest == 0u ? otherwise : primitive;
}

// Triangle tests are postponed until a lane of the subgroup has triangles of three nodes: with tests after each node,
// most lanes would be idle while a few lanes test triangles. Two triangles are tested at a time, which hides the
// latency of loading them.
Hit walkWide(vec3 origin, vec3 direction, uint excludedFace, inout uint iterationCount) {
  const RayFrame frame = makeRayFrame(direction);
  const WideRay ray = makeWideRay(origin, direction);
  uint stackBases[kMaxWideBvhDepth];
  uint stackBits[kMaxWideBvhDepth];
  uint stackSize = 0u;
  Group group = Group(0u, 8u);  // The root.
  LeafQueue queue = LeafQueue(kNoLeaves, kNoLeaves, kNoLeaves);
  Hit hit = Hit(kFarAway, kNoPrimitive, true);

  while (group.bits != 0u) {
    while (group.bits != 0u) {
      const uint index = takeNearest(group, ray.isNegative);
      if (hasMore(group)) {
        stackBases[stackSize] = group.base;
        stackBits[stackSize] = group.bits;
        ++stackSize;
      }
      const DeviceWideNode node = loadWideNode(index);
      const uint children = enterChildren(node, ray, hit.distance);
      group = groupOf(node, children, ray.isNegative);
      if (group.bits == 0u && stackSize > 0u) {
        --stackSize;
        group = Group(stackBases[stackSize], stackBits[stackSize]);
      }
      add(queue, Leaves(node.triangleBase, children & ~kWideInnerBits, node.childBits & ~kWideInnerBits));
      if (++iterationCount > kIterationLimit) group.bits = 0u;
      if (subgroupAny(queue.third.bits != 0u)) break;
    }
    while (queue.first.bits != 0u) {
      const uint primitive = takePrimitive(queue, kNoPrimitive);
      testTriangles(frame, origin, primitive, takePrimitive(queue, primitive), excludedFace, hit);
      ++iterationCount;
    }
    iterationCount += 3u;  // One iteration of this loop, and the entries of the two inner loops.
  }
  hit.isComplete = iterationCount <= kIterationLimit;
  return hit;
}
