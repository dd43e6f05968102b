#include "trace/triangle_planes.h"

#include "core/parallel.h"
#include "core/prefetch.h"

namespace asdfvk {

UnsetVector<TrianglePlane> trianglePlanes(const TraceScene& scene) {
  UnsetVector<TrianglePlane> planes(scene.bvh.primitiveFaces.size());
  constexpr size_t kPrefetchDistance = 16;  // Unit: primitives.
  forEachInParallel(planes.size(), [&](size_t primitive) {
    if (primitive + kPrefetchDistance < planes.size()) {
      const uint32_t later = scene.bvh.primitiveFaces[primitive + kPrefetchDistance];
      prefetchMemory(&scene.geometry.normals[later]);
      prefetchMemory(&scene.geometry.barycentres[later]);
    }
    const uint32_t face = scene.bvh.primitiveFaces[primitive];
    const Vec3d& normal = scene.geometry.normals[face];
    planes[primitive] = {normal, dot(normal, scene.bvh.normalization.toNormalized(scene.geometry.barycentres[face]))};
  });
  return planes;
}

}  // namespace asdfvk
