#version 450
// Copies every field of the structs shared with the host to `words`, in the order of their declaration.
#extension GL_GOOGLE_include_directive : require
#include "shared/bvh_layout.h"
#include "shared/cone_layout.h"

layout(local_size_x = 8) in;
layout(set = 0, binding = 0, rgba32ui) uniform readonly uimageBuffer nodes;
layout(set = 0, binding = 1, rgba32ui) uniform readonly uimageBuffer triangles;
layout(set = 0, binding = 2) readonly buffer Rays { ConeRay rays[]; };
layout(set = 0, binding = 3) readonly buffer Origins { ConeOrigin origins[]; };
layout(set = 0, binding = 4) writeonly buffer Words { uint words[]; };

uint next = 0u;
void put(uint word) { words[next++] = word; }
void put(vec3 v) {
  put(floatBitsToUint(v.x));
  put(floatBitsToUint(v.y));
  put(floatBitsToUint(v.z));
}

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  const int n = int(kBvhNodeTexelCount);  // the second of two, so that the stride is proven too
  const DeviceBvhNode node = decodeBvhNode(imageLoad(nodes, n), imageLoad(nodes, n + 1), imageLoad(nodes, n + 2),
                                           imageLoad(nodes, n + 3));
  put(node.leftMin), put(node.left), put(node.leftMax), put(node.unused0);
  put(node.rightMin), put(node.right), put(node.rightMax), put(node.unused1);
  const int t = int(kBvhTriangleTexelCount);
  const DeviceTriangle triangle =
      decodeTriangle(imageLoad(triangles, t), imageLoad(triangles, t + 1), imageLoad(triangles, t + 2));
  put(triangle.v0), put(triangle.faceIndex), put(triangle.v1), put(floatBitsToUint(triangle.normalU));
  put(triangle.v2), put(floatBitsToUint(triangle.normalV));
  put(rays[1].direction), put(floatBitsToUint(rays[1].weight));
  put(origins[1].origin), put(origins[1].excludedFace), put(origins[1].tangent), put(origins[1].unused0);
  put(origins[1].bitangent), put(origins[1].unused1);
}
