#include "trace/triangle_planes.h"

#include "core/parallel.h"

namespace asdfvk {

UnsetVector<TrianglePlane> trianglePlanes(const TraceScene& scene) {
  UnsetVector<TrianglePlane> planes(scene.bvh.primitiveFaces.size());
  forEachInParallel(planes.size(), [&](size_t primitive) {
    const uint32_t face = scene.bvh.primitiveFaces[primitive];
    const Vec3d& normal = scene.geometry.normals[face];
    planes[primitive] = {normal, dot(normal, scene.bvh.normalization.toNormalized(scene.geometry.barycentres[face]))};
  });
  return planes;
}

}  // namespace asdfvk
