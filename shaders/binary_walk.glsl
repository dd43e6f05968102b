// Nearest hit of one ray in the binary hierarchy of shared/bvh_layout.h.
DeviceBvhNode loadNode(uint index) {
  const uint t = index * kBvhNodeTexelCount;
  return decodeBvhNode(fetchNode(t), fetchNode(t + 1u), fetchNode(t + 2u), fetchNode(t + 3u));
}

// Factor on the exit distance of a box: covers three rounding errors (Ize 2013).
const float kExitMargin = 1.0 + 6.0 * 5.9604645e-8;

// Distance at which the ray enters the box; kFarAway where it misses the box or enters beyond `limit`. The margin of
// the boxes covers the error of the triangle test (kDeviceBoxMargin).
float enterBox(vec3 boxMin, vec3 boxMax, vec3 origin, vec3 inverseDirection, float limit) {
  const vec3 t0 = (boxMin - origin) * inverseDirection;
  const vec3 t1 = (boxMax - origin) * inverseDirection;
  const vec3 tNear = min(t0, t1);
  const vec3 tFar = max(t0, t1);
  const float enter = max(max(tNear.x, tNear.y), max(tNear.z, 0.0));
  const float leave = min(min(tFar.x, tFar.y), tFar.z) * kExitMargin;
  return enter <= min(leave, limit) ? enter : kFarAway;
}

Hit walkBinary(vec3 origin, vec3 direction, uint excludedFace, inout uint iterationCount) {
  const RayFrame frame = makeRayFrame(direction);
  const vec3 inverseDirection = invert(direction);
  uint stack[kMaxBvhDepth];
  uint stackSize = 0u;
  uint current = 0u;
  Hit hit = Hit(kFarAway, kNoPrimitive, true);

  while (current != kNoReference) {
    while (current <= kReferenceFirstMask) {
      const DeviceBvhNode node = loadNode(current);
      const float left = enterBox(node.leftMin, node.leftMax, origin, inverseDirection, hit.distance);
      const float right = enterBox(node.rightMin, node.rightMax, origin, inverseDirection, hit.distance);
      const bool leftIsNear = left <= right;
      const float near = min(left, right);
      const float far = max(left, right);
      if (far < kFarAway) {
        stack[stackSize] = leftIsNear ? node.right : node.left;
        ++stackSize;
      }
      if (near < kFarAway) {
        current = leftIsNear ? node.left : node.right;
      } else if (stackSize > 0u) {
        --stackSize;
        current = stack[stackSize];
      } else {
        current = kNoReference;
      }
      if (++iterationCount > kIterationLimit) {
        hit.isComplete = false;
        current = kNoReference;
      }
    }
    if (current != kNoReference) {
      const uint first = current & kReferenceFirstMask;
      const uint end = first + (current >> kReferenceCountShift);
      for (uint primitive = first; primitive < end; ++primitive)
        testTriangle(frame, origin, primitive, excludedFace, hit);
      iterationCount += end - first + 1u;
      if (stackSize > 0u) {
        --stackSize;
        current = stack[stackSize];
      } else {
        current = kNoReference;
      }
    }
  }
  return hit;
}
