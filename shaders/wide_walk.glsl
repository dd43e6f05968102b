// Walks the wide hierarchy of shared/bvh_layout.h for the nearest hit of one ray (Ylitie, Karras and Laine 2017). A group
// is the children of one node that the ray has still to enter: `base` is the node's childBase; `bits` has bit 4 p + 3
// for each of them, p = its slot ^ the ray's octant, so that the lowest comes first, and bit 4 s + 2 for each slot s of
// the node with an inner child.
const uint kGroupRest = 0x88888888u;

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

// A nibble of ones for each of the four boxes that the ray enters before `limit`.
uint enterBoxes(uvec3 near, uvec3 far, vec3 perByte, vec3 start, float limit) {
  const vec4 nearX = distancesTo(near.x, perByte.x, start.x), farX = distancesTo(far.x, perByte.x, start.x);
  const vec4 nearY = distancesTo(near.y, perByte.y, start.y), farY = distancesTo(far.y, perByte.y, start.y);
  const vec4 nearZ = distancesTo(near.z, perByte.z, start.z), farZ = distancesTo(far.z, perByte.z, start.z);
  const vec4 enter = max(max(nearX, nearY), max(nearZ, vec4(0.0)));
  const vec4 leave = min(min(min(farX, farY), farZ) * kExitMargin, vec4(limit));
  return (enter.x <= leave.x ? 0xfu : 0u) | (enter.y <= leave.y ? 0xf0u : 0u) | (enter.z <= leave.z ? 0xf00u : 0u) |
         (enter.w <= leave.w ? 0xf000u : 0u);
}

// Moves nibble s to s ^ octant.
uint permuteNibbles(uint bits, uvec3 isNegative) {
  if (isNegative.x != 0u) bits = (bits & 0x0f0f0f0fu) << 4 | (bits >> 4 & 0x0f0f0f0fu);
  if (isNegative.y != 0u) bits = (bits & 0x00ff00ffu) << 8 | (bits >> 8 & 0x00ff00ffu);
  if (isNegative.z != 0u) bits = bits << 16 | bits >> 16;
  return bits;
}

// The exponent of a power of two below 2^31.
uint exponentOf(uint power) { return (floatBitsToUint(float(int(power))) >> 23) - 127u; }

Hit walkWide(vec3 origin, vec3 direction, uint excludedFace, inout uint iterationCount) {
  const RayFrame frame = makeRayFrame(direction);
  const vec3 inverseDirection = invert(direction);
  const bvec3 isNegative = lessThan(direction, vec3(0.0));
  const uvec3 signBits = uvec3(isNegative);
  const uint octantShift = signBits.x << 2 | signBits.y << 3 | signBits.z << 4;
  uint stackBases[kMaxWideBvhDepth];
  uint stackBits[kMaxWideBvhDepth];
  uint stackSize = 0u;
  uint groupBase = 0u;
  uint groupBits = 8u;  // The root.
  uint triangleBase = 0u, triangleBits = 0u, leafBits = 0u;
  Hit hit = Hit(kFarAway, kNoSlot, true);

  while (groupBits != 0u) {
    while (groupBits != 0u && triangleBits == 0u) {
      const uint rest = (groupBits & kGroupRest) >> 3;
      const uint nearest = rest & (~rest + 1u);
      const uint below = (1u << (exponentOf(nearest) ^ octantShift)) - 1u;
      const uint rank = ((groupBits >> 2 & 0x11111111u & below) * 0x11111111u) >> 28;
      const uint index = groupBase + rank;
      groupBits ^= nearest << 3;
      if ((groupBits & kGroupRest) != 0u) {
        stackBases[stackSize] = groupBase;
        stackBits[stackSize] = groupBits;
        ++stackSize;
      }
      const DeviceWideNode node = loadWideNode(index);
      const uvec3 exponents = uvec3(node.exponents << 23, node.exponents << 15, node.exponents << 7) & 0x7f800000u;
      const vec3 perByte = uintBitsToFloat(exponents) * inverseDirection;
      const vec3 start = (node.origin - origin) * inverseDirection;
      const uvec4 x = isNegative.x ? node.x.zwxy : node.x;
      const uvec4 y = isNegative.y ? node.y.zwxy : node.y;
      const uvec4 z = isNegative.z ? node.z.zwxy : node.z;
      const uint entered =
          (enterBoxes(uvec3(x.x, y.x, z.x), uvec3(x.z, y.z, z.z), perByte, start, hit.distance) |
           enterBoxes(uvec3(x.y, y.y, z.y), uvec3(x.w, y.w, z.w), perByte, start, hit.distance) << 16) & node.childBits;
      triangleBits = entered & ~kWideInnerBits;
      triangleBase = node.triangleBase;
      leafBits = node.childBits & ~kWideInnerBits;
      groupBits = permuteNibbles(entered & kWideInnerBits, signBits);
      if (groupBits != 0u) {
        groupBits |= (node.childBits & kWideInnerBits) >> 1;
        groupBase = node.childBase;
      } else if (stackSize > 0u) {
        --stackSize;
        groupBase = stackBases[stackSize];
        groupBits = stackBits[stackSize];
      }
      if (++iterationCount > kIterationLimit) groupBits = 0u;
    }
    while (triangleBits != 0u) {
      const uint lowest = triangleBits & (~triangleBits + 1u);
      triangleBits ^= lowest;
      const uint slot = triangleBase + bitCount(leafBits & (lowest - 1u));
      const DeviceTriangle triangle = loadTriangle(slot);
      const float t = intersectTriangle(frame, triangle.v0 - origin, triangle.v1 - origin, triangle.v2 - origin);
      if (t >= 0.0 && t < hit.distance && triangle.faceIndex != excludedFace) {
        hit.distance = t;
        hit.slot = slot;
      }
      ++iterationCount;
    }
    iterationCount += 3u;  // This loop's own, and what entering the two inner ones costs.
  }
  hit.isComplete = iterationCount <= kIterationLimit;
  return hit;
}
