#include "predict/traced_cones.h"

#include <array>

namespace asdfvk {

bool isValidHit(const TraceScene& scene, const Cone& cone, uint32_t seedFace, const ConeHit& hit) {
  return hit.face != kNoFace && !isFalseHit(cone, scene.geometry.normals[seedFace], scene.geometry.normals[hit.face]);
}

LengthWindow keptLengths(const TraceScene& scene, const Cone& cone, const TracedCones& traced, uint32_t seed) {
  std::array<double, kMaxRayCount> lengths;
  size_t count = 0;
  for (const ConeHit& hit : traced.hitsOf(seed))
    if (isValidHit(scene, cone, traced.seeds[seed], hit)) lengths[count++] = static_cast<double>(hit.distance);
  return count > 0 ? keptWindow({lengths.data(), count}, cone.outlierDeviations) : LengthWindow{};
}

}  // namespace asdfvk
