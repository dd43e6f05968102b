#include "bvh/device_bvh.h"

#include <algorithm>
#include <cmath>

#include "core/prefetch.h"

namespace asdfvk {
namespace {

// In primitives. The faces and vertices of consecutive primitives may be far apart in memory. A face must be in the
// cache before its vertices can be prefetched.
constexpr size_t kFacePrefetchDistance = 16, kVertexPrefetchDistance = 8;

vec3 toDevice(const Vec3f& v) { return {v.x, v.y, v.z}; }

struct OctahedralNormal {
  float u, v;
};

// Branch-free, because the sign of z is unpredictable. -0, which occurs in normals of reversed faces, has the code of
// 0.
OctahedralNormal encodeNormal(const Vec3d& n) {
  const double scale = 1 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  const double u = n.x * scale, v = n.y * scale;
  const double foldedU = std::copysign(1 - std::abs(v), n.x + 0.0), foldedV = std::copysign(1 - std::abs(u), n.y + 0.0);
  const bool isUp = n.z >= 0;
  return {static_cast<float>(isUp ? u : foldedU), static_cast<float>(isUp ? v : foldedV)};
}

}  // namespace

uint64_t maxBlockCount(const Bvh& bvh) {
  const uint64_t innerCount = bvh.nodes.size() / 2;  // Each inner node has two children and becomes a node or a leaf.
  return std::max(std::max<uint64_t>(1, innerCount) * kWideNodeTexelCount,
                  uint64_t{bvh.primitiveFaces.size()} * kBvhTriangleTexelCount);
}

void encodeTriangles(const Bvh& bvh, const TriangleMesh& mesh, const FaceGeometry& geometry,
                     std::span<const uint32_t> primitiveFaces, std::span<DeviceTriangle> triangles) {
  for (size_t primitive = 0; primitive < triangles.size(); ++primitive) {
    const uint32_t face = primitiveFaces[primitive];
    if (primitive + kFacePrefetchDistance < triangles.size()) {
      const uint32_t later = primitiveFaces[primitive + kFacePrefetchDistance];
      prefetchMemory(&mesh.faces[later]);
      prefetchMemory(&geometry.normals[later]);
    }
    if (primitive + kVertexPrefetchDistance < triangles.size())
      for (const uint32_t vertex : mesh.faces[primitiveFaces[primitive + kVertexPrefetchDistance]])
        prefetchMemory(&mesh.vertices[vertex]);
    const auto corner = [&](size_t k) {
      return toDevice(Vec3f(bvh.normalization.toNormalized(mesh.vertices[mesh.faces[face][k]])));
    };
    const OctahedralNormal normal = encodeNormal(geometry.normals[face]);
    triangles[primitive] = {corner(0), face, corner(1), normal.u, corner(2), normal.v};
  }
}

}  // namespace asdfvk
