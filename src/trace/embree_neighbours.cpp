#include "trace/embree_neighbours.h"

#include <cmath>

namespace asdfvk {
namespace {

struct Query {
  const TraceScene& scene;
  std::span<const SlotPlane> planes;
  Vec3d point;
  uint32_t slot;
  double radius;
  bool isFound = false;

  /// By the plane and the three lines of the edges, each moved outwards by the radius: beyond an acute corner this
  /// reaches farther.
  [[nodiscard]] bool isNear(uint32_t other) const {
    const SlotPlane& plane = planes[other];
    if (std::abs(dot(plane.normal, point) - plane.offset) > radius) return false;
    const Face& face = scene.mesh.faces[scene.bvh.slotFaces[other]];
    const auto corner = [&](size_t k) { return scene.bvh.normalization.toNormalized(scene.mesh.vertices[face[k]]); };
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d edge = corner((k + 1) % 3) - corner(k);
      if (dot(cross(plane.normal, edge), point - corner(k)) < -radius * length(edge)) return false;
    }
    return true;
  }
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<Query*>(arguments->userPtr);
  if (arguments->primID == query.slot || query.isFound || !query.isNear(arguments->primID)) return false;
  query.isFound = true;
  arguments->query->radius = 0;
  return true;
}

}  // namespace

bool hasNeighbourWithin(const EmbreeScene& embree, const TraceScene& scene, std::span<const SlotPlane> planes,
                        const Vec3d& point, uint32_t slot, double radius) {
  Query query{scene, planes, point, slot, radius};
  // float32 moves the point, and the boxes that hold the triangles.
  constexpr float kRounding = 0x1p-23f;
  RTCPointQuery sphere{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z), 0,
                       static_cast<float>(radius) + kRounding};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(embree.get(), &sphere, &context, visit, &query);
  return query.isFound;
}

}  // namespace asdfvk
