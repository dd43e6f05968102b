#include "trace/solids.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "core/parallel.h"
#include "mesh/cavities.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNoComponent = 0xffffffff;

/// Parallel to no axis, plane and diagonal along which meshes are often built; no two of them are opposite.
constexpr std::array<Vec3d, 5> kDirections{{{0.536, 0.672, 0.511},
                                            {-0.783, 0.319, 0.534},
                                            {0.241, -0.851, 0.467},
                                            {-0.412, -0.287, -0.865},
                                            {0.604, 0.263, -0.752}}};

/// Rays out of the cavities, each from the vertex that is farthest in the direction: it meets no face of its cavity.
class CavityRays {
 public:
  CavityRays(const TraceScene& scene, const Components& components, std::span<const uint8_t> isCavity)
      : scene_(scene), components_(components), isCavity_(isCavity) {}

  /// For each cavity, the component through whose inner side the ray leaves the material; kNoComponent for none.
  [[nodiscard]] std::vector<uint32_t> firstLeft(const Vec3d& direction) const {
    std::vector<Vec3d> origins(isCavity_.size());
    std::vector<double> farthest(isCavity_.size(), -std::numeric_limits<double>::infinity());
    for (uint32_t face = 0; face < scene_.mesh.faceCount(); ++face) {
      const uint32_t component = components_.componentOf[face];
      if (isCavity_[component] == 0) continue;
      for (const uint32_t vertex : scene_.mesh.faces[face]) {
        const Vec3d p = scene_.bvh.normalization.toNormalized(scene_.mesh.vertices[vertex]);
        if (dot(p, direction) <= farthest[component]) continue;
        farthest[component] = dot(p, direction);
        origins[component] = p;
      }
    }
    std::vector<uint32_t> left(isCavity_.size(), kNoComponent);
    forEachInParallel(isCavity_.size(), [&](size_t cavity) {
      if (isCavity_[cavity] == 0) return;
      const uint32_t face =
          nearestHit(scene_.bvh, scene_.mesh, origins[cavity], direction, kNoFace, kContactDistance).face;
      if (face != kNoFace && dot(scene_.geometry.normals[face], direction) > 0)
        left[cavity] = components_.componentOf[face];
    });
    return left;
  }

 private:
  const TraceScene& scene_;
  const Components& components_;
  std::span<const uint8_t> isCavity_;
};

/// Gives each cavity the closed component that most of its rays find. Where parts cross, rays differ.
void assignCavities(const CavityRays& rays, std::span<const uint8_t> isCavity, std::span<const uint8_t> isClosed,
                    std::span<uint32_t> solidOfComponent) {
  std::vector<std::array<uint32_t, kDirections.size()>> found(isCavity.size());
  for (size_t k = 0; k < kDirections.size(); ++k) {
    const std::vector<uint32_t> left = rays.firstLeft(kDirections[k] / length(kDirections[k]));
    for (size_t cavity = 0; cavity < isCavity.size(); ++cavity) {
      if (isCavity[cavity] == 0) continue;
      uint32_t outer = left[cavity];
      // It ends: the next cavity reaches farther in the direction.
      while (outer != kNoComponent && isCavity[outer] != 0) outer = left[outer];
      found[cavity][k] = outer != kNoComponent && isClosed[outer] != 0 ? outer : kNoComponent;
    }
  }
  for (size_t cavity = 0; cavity < isCavity.size(); ++cavity) {
    if (isCavity[cavity] == 0) continue;
    std::ptrdiff_t most = 0;
    for (const uint32_t outer : found[cavity]) {
      const std::ptrdiff_t count = std::count(found[cavity].begin(), found[cavity].end(), outer);
      if (outer == kNoComponent || count <= most) continue;
      most = count;
      solidOfComponent[cavity] = outer;
    }
  }
}

}  // namespace

Solids findSolids(const TraceScene& scene, const Components& components) {
  const size_t count = components.components.size();
  Solids solids{std::vector<uint32_t>(scene.mesh.faceCount()), std::vector<uint8_t>(count),
                std::vector<uint8_t>(count)};
  const std::vector<uint8_t> isCavity = findCavities(scene.mesh, components);
  std::vector<uint32_t> solidOfComponent(count);
  for (uint32_t c = 0; c < count; ++c) {
    const Component& component = components.components[c];
    const double outwards = isCavity[c] != 0 ? -component.signedVolume : component.signedVolume;
    solids.isClosed[c] =
        component.isClosed && component.isConsistentlyWound && outwards > 0 && isCavity[c] == 0 ? 1 : 0;
    solids.isMisoriented[c] = component.isClosed && (!component.isConsistentlyWound || outwards < 0) ? 1 : 0;
    solidOfComponent[c] = c;
  }
  if (std::find(isCavity.begin(), isCavity.end(), 1) != isCavity.end())
    assignCavities(CavityRays(scene, components, isCavity), isCavity, solids.isClosed, solidOfComponent);
  for (uint32_t face = 0; face < scene.mesh.faceCount(); ++face)
    solids.solidOf[face] = solidOfComponent[components.componentOf[face]];
  return solids;
}

}  // namespace asdfvk
