#include "render/scene.h"

#include <algorithm>
#include <cmath>

#include "render/corner_normals.h"
#include "render/image.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

/// Distance of the ray origin from the box, so that rounding does not move it behind a face on the side of the box.
constexpr double kClearance = 1e-3;

/// Share of each corner in the triangle's point that is nearest to p or near it: never negative, adding up to 1.
std::array<double, 3> barycentrics(const std::array<Vec3d, 3>& corners, const Vec3d& normal, const Vec3d& p) {
  std::array<double, 3> shares{};
  double total = 0;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d a = corners[(k + 1) % 3] - p, b = corners[(k + 2) % 3] - p;
    shares[k] = std::max(0.0, dot(cross(a, b), normal));
    total += shares[k];
  }
  if (!(total > 0)) return {1, 0, 0};
  for (double& share : shares) share /= total;
  return shares;
}

}  // namespace

std::optional<LineHit> firstOnLine(const TraceScene& scene, const Vec3d& point, const Vec3d& direction) {
  const Bvh& bvh = scene.bvh;
  if (bvh.nodes.empty()) return std::nullopt;
  // nearestHit() requires an origin near the box, for its rounding bounds. Most rays of a picture miss the box.
  const BvhNode& root = bvh.nodes[0];
  double enter = -kNoHit, leave = kNoHit;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    const double low = double(root.min[axis]) - kClearance - point[axis];
    const double high = double(root.max[axis]) + kClearance - point[axis];
    if (std::abs(d) < 1e-12) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    enter = std::max(enter, std::min(low / d, high / d));
    leave = std::min(leave, std::max(low / d, high / d));
  }
  if (!(enter <= leave)) return std::nullopt;
  const Vec3d origin = point + direction * enter;
  const RayHit hit = nearestHit(bvh, scene.mesh, origin, direction, kNoFace);
  if (hit.face == kNoFace) return std::nullopt;
  return LineHit{hit.face, origin + direction * hit.distance};
}

PictureScene::PictureScene(const TraceScene& scene)
    : scene_(scene), cornerNormals_(cornerNormals(scene.mesh, scene.geometry)) {}

std::vector<Vec3d> PictureScene::points() const {
  std::vector<Vec3d> points;
  points.reserve(scene_.bvh.primitiveFaces.size() * 3);
  for (const uint32_t face : scene_.bvh.primitiveFaces)
    for (const uint32_t vertex : scene_.mesh.faces[face])
      points.push_back(scene_.bvh.normalization.toNormalized(scene_.mesh.vertices[vertex]));
  return points;
}

std::optional<SurfacePoint> PictureScene::firstOnLine(const Vec3d& point, const Vec3d& direction) const {
  const std::optional<LineHit> hit = asdfvk::firstOnLine(scene_, point, direction);
  return hit ? std::optional(describe(hit->face, hit->position, direction)) : std::nullopt;
}

double PictureScene::freeDistance(const Vec3d& origin, const Vec3d& direction, uint32_t skippedFace) const {
  return nearestHit(scene_.bvh, scene_.mesh, origin, direction, skippedFace).distance;
}

SurfacePoint PictureScene::describe(uint32_t face, const Vec3d& position, const Vec3d& direction) const {
  const Vec3d& outward = scene_.geometry.normals[face];
  std::array<Vec3d, 3> corners;
  for (size_t k = 0; k < 3; ++k)
    corners[k] = scene_.bvh.normalization.toNormalized(scene_.mesh.vertices[scene_.mesh.faces[face][k]]);
  const std::array<double, 3> shares = barycentrics(corners, outward, position);
  const double side = dot(outward, direction) > 0 ? -1 : 1;

  SurfacePoint result{face, position, {}, outward * side, {}};
  Vec3d normal, lift;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3d cornerNormal = cornerNormals_[face][k] * side;
    normal += cornerNormal * shares[k];
    // Onto the corners' tangent planes, else flat faces cast shadows on a round body (Hanika 2021, Hacking the Shadow
    // Terminator).
    lift += cornerNormal * (shares[k] * std::max(0.0, dot(corners[k] - position, cornerNormal)));
  }
  result.normal = unitVector(normal, result.faceNormal);
  result.lifted = position + lift + result.faceNormal * 1e-7;
  return result;
}

}  // namespace asdfvk
