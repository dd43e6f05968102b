// Access to the texels of the hierarchy: bindings 0 to 3 of every traversal kernel. The texels are in images or in
// buffers; images are much faster on llvmpipe.
#include "shared/bvh_layout.h"
#include "shared/specialization_ids.h"

layout(constant_id = kFetchesTexelsId) const bool kFetchesTexels = true;

layout(set = 0, binding = 0, rgba32ui) uniform readonly uimageBuffer nodeTexels;
layout(set = 0, binding = 1, rgba32ui) uniform readonly uimageBuffer triangleTexels;
layout(set = 0, binding = 2) readonly buffer Nodes { uvec4 nodeBlocks[]; };
layout(set = 0, binding = 3) readonly buffer Triangles { uvec4 triangleBlocks[]; };

uvec4 fetchNode(uint index) {
  if (kFetchesTexels) return imageLoad(nodeTexels, int(index));
  return nodeBlocks[index];
}

uvec4 fetchTriangle(uint index) {
  if (kFetchesTexels) return imageLoad(triangleTexels, int(index));
  return triangleBlocks[index];
}

DeviceTriangle loadTriangle(uint primitive) {
  const uint t = primitive * kBvhTriangleTexelCount;
  return decodeTriangle(fetchTriangle(t), fetchTriangle(t + 1u), fetchTriangle(t + 2u));
}
