#version 450
// Copies every field of the structs shared with the host to `words`, in the order of their declaration.
#extension GL_GOOGLE_include_directive : require
#include "shared/bvh_layout.h"
#include "shared/cone_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0, rgba32ui) uniform readonly uimageBuffer nodes;
layout(set = 0, binding = 1, rgba32ui) uniform readonly uimageBuffer triangles;
layout(set = 0, binding = 2, rgba32ui) uniform readonly uimageBuffer rays;
layout(set = 0, binding = 3, rgba32ui) uniform readonly uimageBuffer origins;
layout(set = 0, binding = 5) readonly buffer Seeds { ConeSeed seeds[]; };
layout(set = 0, binding = 4) writeonly buffer Words { uint words[]; };

uint next = 0u;
void put(uint word) { words[next++] = word; }
void put(uvec4 v) {
  put(v.x);
  put(v.y);
  put(v.z);
  put(v.w);
}
void put(vec3 v) {
  put(floatBitsToUint(v.x));
  put(floatBitsToUint(v.y));
  put(floatBitsToUint(v.z));
}

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  const int n = int(kWideNodeTexelCount);  // the second of two, so that the stride is proven too
  const DeviceWideNode node = decodeWideNode(imageLoad(nodes, n), imageLoad(nodes, n + 1), imageLoad(nodes, n + 2),
                                             imageLoad(nodes, n + 3), imageLoad(nodes, n + 4));
  put(node.origin), put(node.exponents), put(node.childBase), put(node.triangleBase);
  put(node.childBits), put(node.unused), put(node.x), put(node.y), put(node.z);
  const int t = int(kBvhTriangleTexelCount);
  const DeviceTriangle triangle =
      decodeTriangle(imageLoad(triangles, t), imageLoad(triangles, t + 1), imageLoad(triangles, t + 2));
  put(triangle.v0), put(triangle.faceIndex), put(triangle.v1), put(floatBitsToUint(triangle.normalU));
  put(triangle.v2), put(floatBitsToUint(triangle.normalV));
  const ConeRay ray = decodeConeRay(imageLoad(rays, 1));
  put(ray.direction), put(floatBitsToUint(ray.weight));
  const int o = int(kConeOriginTexelCount);
  const ConeOrigin origin =
      decodeConeOrigin(imageLoad(origins, o), imageLoad(origins, o + 1), imageLoad(origins, o + 2));
  put(origin.origin), put(origin.excludedFace), put(origin.tangent), put(origin.unused0);
  put(origin.bitangent), put(origin.unused1);
  put(seeds[1].triangle), put(floatBitsToUint(seeds[1].halfTurn));
}
