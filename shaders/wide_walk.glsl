// Walks the wide hierarchy of shared/bvh_layout.h for the nearest hit of one ray (Ylitie, Karras and Laine 2017).
#extension GL_KHR_shader_subgroup_vote : require

DeviceWideNode loadWideNode(uint index) {
  const uint t = index * kWideNodeTexelCount;
  return decodeWideNode(fetchNode(t), fetchNode(t + 1u), fetchNode(t + 2u), fetchNode(t + 3u), fetchNode(t + 4u));
}

// The distances to the planes of four boxes on one axis. The bytes are converted where they are: signed conversions are
// the quick ones.
vec4 distancesTo(uint bytes, float perByte, float start) {
  const vec4 planes = vec4(int(bytes & 0xffu), int(bytes & 0xff00u), int(bytes & 0xff0000u), int(bytes >> 24));
  return planes * (perByte * vec4(1.0, 1.0 / 256.0, 1.0 / 65536.0, 1.0)) + start;
}

// A nibble of ones for each of the four boxes that the ray enters before `limit`. Distances are compared by their bits,
// which order those that are not negative. Of a box altogether before the ray's origin, where it would be left is one
// of the nearest planes by bits and where it would be entered one of the farthest, so it is not entered. (Of floats
// llvmpipe takes three instructions for each minimum, on behalf of NaNs that do not come here.) Needs no margin for
// rounding: kWideBoxMargin has it.
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

// What the walk needs of a ray.
struct WideRay {
  vec3 origin, inverseDirection;
  bvec3 isNegative;  // Of the direction.
};

WideRay makeWideRay(vec3 origin, vec3 direction) {
  return WideRay(origin, invert(direction), lessThan(direction, vec3(0.0)));
}

// A nibble for each child that the ray enters before `limit`: the child's nibble of childBits.
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

// The children of one node that the ray has still to enter: `base` is the node's childBase; `bits` has bit 4 p + 3 for
// each of them, p = its slot ^ the ray's octant, so that the lowest comes first, and bit 4 s + 2 for each slot s of the
// node with an inner child. bits is 0 when there are none.
struct Group {
  uint base, bits;
};

Group groupOf(DeviceWideNode node, uint children, bvec3 isNegative) {
  const uint rest = permuteNibbles(children & kWideInnerBits, isNegative);
  return Group(node.childBase, rest == 0u ? 0u : rest | (node.childBits & kWideInnerBits) >> 1);
}

bool hasMore(Group group) { return (group.bits & kWideInnerBits) != 0u; }

// Takes the nearest out of a group that has one and returns its node.
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

// The triangles of one node that the ray has still to be tested with: `bits` of `all` those that there are, in the
// nibbles of DeviceWideNode::childBits.
struct Leaves {
  uint base, bits, all;
};

const Leaves kNoLeaves = Leaves(0u, 0u, 0u);

// Those that wait, none behind one that is empty.
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

// Takes a triangle out and returns its slot, or `otherwise` where none waits.
uint takeSlot(inout LeafQueue queue, uint otherwise) {
  const uint lowest = queue.first.bits & (~queue.first.bits + 1u);
  const uint slot = queue.first.base + bitCount(queue.first.all & (lowest - 1u));
  queue.first.bits ^= lowest;
  if (queue.first.bits == 0u) {
    queue.first = queue.second;
    queue.second = queue.third;
    queue.third.bits = 0u;
  }
  return lowest == 0u ? otherwise : slot;
}

// Triangles wait until some lane has those of three nodes to test: otherwise most lanes would wait for the few that
// have one after nearly every node. Then two are tested at a time, which fills the waiting for either's texels.
Hit walkWide(vec3 origin, vec3 direction, uint excludedFace, inout uint iterationCount) {
  const RayFrame frame = makeRayFrame(direction);
  const WideRay ray = makeWideRay(origin, direction);
  uint stackBases[kMaxWideBvhDepth];
  uint stackBits[kMaxWideBvhDepth];
  uint stackSize = 0u;
  Group group = Group(0u, 8u);  // The root.
  LeafQueue queue = LeafQueue(kNoLeaves, kNoLeaves, kNoLeaves);
  Hit hit = Hit(kFarAway, kNoSlot, true);

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
      const uint slot = takeSlot(queue, kNoSlot);
      testTriangles(frame, origin, slot, takeSlot(queue, slot), excludedFace, hit);
      ++iterationCount;
    }
    iterationCount += 3u;  // This loop's own, and what entering the two inner ones costs.
  }
  hit.isComplete = iterationCount <= kIterationLimit;
  return hit;
}
