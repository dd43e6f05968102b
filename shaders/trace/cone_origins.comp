#version 450
// Computes the starts of the cones of seed faces for Definition::Paper from the triangles of the hierarchy, one cone
// per lane. The twin of coneStartOfFace() in src/trace/cone_start.h.
#extension GL_GOOGLE_include_directive : require
#include "shared/cone_layout.h"
#include "shared/specialization_ids.h"

#include "bvh_fetch.glsl"

layout(local_size_x_id = kLocalSizeXId) in;
layout(set = 0, binding = 4) readonly buffer Seeds { ConeSeed seeds[]; };
layout(set = 0, binding = 5) writeonly buffer Origins { ConeOrigin origins[]; };
layout(push_constant) uniform Push { ConePush push; };

void main() {
  const uint cone = gl_GlobalInvocationID.x;
  if (cone >= push.coneCount) return;
  const ConeSeed seed = seeds[cone];
  const DeviceTriangle triangle = loadTriangle(seed.triangle & ~kFlippedFrameBit);
  const vec3 axis = -decodeNormal(triangle.normalU, triangle.normalV);
  // See coneFrame() in src/cone/cone.h.
  const float s = (seed.triangle & kFlippedFrameBit) != 0u ? -1.0 : 1.0;
  const float a = -1.0 / (s + axis.z);
  const float b = axis.x * axis.y * a;
  const vec3 tangent = vec3(1.0 + s * axis.x * axis.x * a, s * b, -s * axis.x);
  const vec3 bitangent = vec3(b, s + axis.y * axis.y * a, -axis.y);
  const float scale = 1.0 / (1.0 + seed.halfTurn * seed.halfTurn);
  const float cosine = (1.0 - seed.halfTurn * seed.halfTurn) * scale, sine = 2.0 * seed.halfTurn * scale;
  origins[cone] = ConeOrigin((triangle.v0 + triangle.v1 + triangle.v2) * (1.0 / 3.0), triangle.faceIndex,
                             cosine * tangent + sine * bitangent, 0u, cosine * bitangent - sine * tangent, 0u);
}
