#include "render/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bucket_sort.h"
#include "core/parallel.h"
#include "core/vec3.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxSmoothedValence = 64;

double angleAt(const TriangleMesh& mesh, uint32_t face, size_t k) {
  const Face& corners = mesh.faces[face];
  const Vec3d& apex = mesh.vertices[corners[k]];
  const Vec3d a = unitVector(mesh.vertices[corners[(k + 1) % 3]] - apex, {});
  const Vec3d b = unitVector(mesh.vertices[corners[(k + 2) % 3]] - apex, {});
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

}  // namespace

std::vector<std::array<Vec3d, 3>> cornerNormals(const TriangleMesh& mesh, const FaceGeometry& geometry) {
  // Entries are 3 * face + corner. 32 bits suffice, because the dual graph limits a mesh to 2^32 / 3 faces.
  const auto corners = sortIntoBuckets<uint32_t>(mesh.vertices.size(), mesh.faceCount(), [&](uint32_t face, auto put) {
    if (geometry.isDegenerate(face)) return;
    for (uint32_t k = 0; k < 3; ++k) put(mesh.faces[face][k], 3 * face + k);
  });
  const double creaseCosine = std::cos(kCreaseAngleDegrees * std::numbers::pi / 180);
  std::vector<std::array<Vec3d, 3>> normals(mesh.faceCount());
  forEachInParallel(mesh.faceCount(), [&](uint32_t face) {
    const Vec3d& own = geometry.normals[face];
    for (size_t k = 0; k < 3; ++k) {
      const auto around = corners[mesh.faces[face][k]];
      Vec3d sum;
      if (around.size() <= kMaxSmoothedValence)
        for (const uint32_t corner : around) {
          const Vec3d& other = geometry.normals[corner / 3];
          const double cosine = dot(own, other);
          if (std::abs(cosine) < creaseCosine) continue;
          sum += other * std::copysign(angleAt(mesh, corner / 3, corner % 3), cosine);
        }
      normals[face][k] = unitVector(sum, own);
    }
  });
  return normals;
}

}  // namespace asdfvk
