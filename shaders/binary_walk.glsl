// Nearest hit of one ray in the binary hierarchy of shared/bvh_layout.h.
layout(constant_id = 11) const uint kBinaryStackSize = kMaxBvhDepth;  // See kWideStackSize.

DeviceBvhNode loadNode(uint index) {
  const uint t = index * kBvhNodeTexelCount;
  return decodeBvhNode(fetchNode(t), fetchNode(t + 1u), fetchNode(t + 2u), fetchNode(t + 3u));
}

Hit walkBinary(Query query, inout uint iterationCount) {
  uint stack[kBinaryStackSize];
  uint stackSize = 0u;
  uint current = 0u;
  Hit hit = Hit(kFarAway, kNoPrimitive, true);

  while (current != kNoReference) {
    while (current <= kReferenceFirstMask) {
      const DeviceBvhNode node = loadNode(current);
      const float left = enterBox(node.leftMin, node.leftMax, query, hit.distance);
      const float right = enterBox(node.rightMin, node.rightMax, query, hit.distance);
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
      for (uint primitive = first; primitive < end; ++primitive) testTriangle(query, primitive, hit);
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
