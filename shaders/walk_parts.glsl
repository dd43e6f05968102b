// Common parts of the traversals of both hierarchies. Needs the constant kIterationLimit.
#include "bvh_fetch.glsl"

const uint kNoPrimitive = 0xffffffffu;
const float kFarAway = 1e30;  // Greater than any distance in normalised coordinates.

struct Hit {
  float distance;
  uint primitive;   // kNoPrimitive: no hit.
  bool isComplete;  // False: the iteration limit ended the traversal.
};

// Replaces `hit` by the triangle in `primitive` if that is nearer. distance: negative where the ray misses the
// triangle.
void keepNearest(float distance, uint primitive, uint faceIndex, uint excludedFace, inout Hit hit) {
  if (distance >= 0.0 && distance < hit.distance && faceIndex != excludedFace) {
    hit.distance = distance;
    hit.primitive = primitive;
  }
}
