#include "trace/embree/slot_planes.h"

#include <tbb/parallel_for.h>

namespace asdfvk {

std::vector<SlotPlane> slotPlanes(const TraceScene& scene) {
  std::vector<SlotPlane> planes(scene.bvh.slotFaces.size());
  tbb::parallel_for(size_t{0}, planes.size(), [&](size_t slot) {
    const uint32_t face = scene.bvh.slotFaces[slot];
    const Vec3d& normal = scene.geometry.normals[face];
    planes[slot] = {normal, dot(normal, scene.bvh.normalization.toNormalized(scene.geometry.barycentres[face]))};
  });
  return planes;
}

}  // namespace asdfvk
