#include "trace/greatest_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "bvh/leaf_faces.h"
#include "core/box3.h"
#include "mesh/coincident_faces.h"
#include "trace/nearest_hit.h"
#include "trace/nearest_point.h"

namespace asdfvk {
namespace {

/// Number of faces of a solid from which rays go inwards.
constexpr size_t kRayCount = 16;
/// Number of first cubes along the longest side of the box of the solid.
constexpr int kFirstCubeCount = 4;
// Corners within this distance of a plane count as points of the plane. The distance is the resolution of coordinates
// in float32.
constexpr double kFlat = 0x1p-22;

class SolidSurface {
 public:
  SolidSurface(const TraceScene& scene, const Buckets<uint32_t>& copies, std::span<const uint32_t> solidOf,
               uint32_t solid)
      : scene_(scene), copies_(copies), solidOf_(solidOf), solid_(solid) {}

  /// The face of the solid among the copies of a primitive, or kNoFace. Touching solids may share primitives.
  [[nodiscard]] uint32_t copyOf(uint32_t primitiveFace) const {
    for (const uint32_t face : copies_[primitiveFace])
      if (solidOf_[face] == solid_) return face;
    return kNoFace;
  }
  [[nodiscard]] const Vec3d& normal(uint32_t face) const { return scene_.geometry.normals[face]; }
  [[nodiscard]] PlaneTriangle triangle(uint32_t face) const { return triangleOf(scene_, face); }

  /// The nearest point of the solid, or any point that is less than `enough` away. atMost: see nearestSurfacePoint().
  [[nodiscard]] SurfacePoint nearest(const Vec3d& p, double enough = 0,
                                     double atMost = std::numeric_limits<double>::infinity()) const {
    return nearestSurfacePoint(
        scene_, p, enough, [&](uint32_t face) { return copyOf(face); }, atMost);
  }

  /// Whether the surface within `radius` of the point is not empty and lies in the plane of `face`. If true, the
  /// surface covers the whole disc, because the solid is closed.
  [[nodiscard]] bool isFlatAround(const Vec3d& point, double radius, uint32_t face) const {
    const Vec3d& plane = normal(face);
    const double offset = dot(plane, triangle(face).corners[0]);
    bool isFlat = true, isFound = false;
    const auto reaches = [&](const BvhNode& node) { return squaredDistanceToBox(node, point) <= radius * radius; };
    forEachLeafFace(scene_.bvh, reaches, [&](uint32_t primitiveFace) {
      const uint32_t other = copyOf(primitiveFace);
      if (other == kNoFace) return true;
      const PlaneTriangle near = triangle(other);
      if (length(point - nearestPoint(near, point)) > radius) return true;
      isFound = true;
      for (const Vec3d& corner : near.corners) isFlat = isFlat && std::abs(dot(plane, corner) - offset) <= kFlat;
      return isFlat;
    });
    return isFlat && isFound;
  }

  [[nodiscard]] RayHit opposite(const Vec3d& p, const Vec3d& direction) const {
    RayHit hit =
        nearestHitAmong(scene_.bvh, scene_.mesh, p, direction, [&](uint32_t face) { return copyOf(face) != kNoFace; });
    if (hit.face != kNoFace) hit.face = copyOf(hit.face);
    return hit;
  }

 private:
  const TraceScene& scene_;
  const Buckets<uint32_t>& copies_;
  std::span<const uint32_t> solidOf_;
  uint32_t solid_;
};

struct Cube {
  Vec3d centre;
  double halfSide = 0;
  double bound = 0;  ///< Bound of the radii of balls with their centres in the cube.
  Vec3d foot;        ///< The point of the surface nearest to the centre.
  bool operator<(const Cube& other) const { return bound < other.bound; }
};

class Search {
 public:
  explicit Search(const SolidSurface& surface) : surface_(surface) {}

  /// stopOnly: for cancellation.
  GreatestSection run(const Box3d& box, std::span<const uint32_t> faces, const SectionSearch& search, uint32_t maxCubes,
                      const RunControl& stopOnly) {
    const uint32_t maxCubeCount =
        maxCubes + search.cubesPerFace * static_cast<uint32_t>(std::min<size_t>(faces.size(), 1u << 24));
    for (size_t i = 0; i < std::min(kRayCount, faces.size()); ++i)
      offerMiddle(faces[i * faces.size() / std::min(kRayCount, faces.size())]);
    const Vec3d size = box.size();
    const double side = std::max({size.x, size.y, size.z}) / kFirstCubeCount;
    for (int i = 0; i < kFirstCubeCount * kFirstCubeCount * kFirstCubeCount; ++i) {
      const Vec3d corner{double(i % kFirstCubeCount), double(i / kFirstCubeCount % kFirstCubeCount),
                         double(i / (kFirstCubeCount * kFirstCubeCount))};
      if (corner.x * side < size.x && corner.y * side < size.y && corner.z * side < size.z)
        add(box.min + side * (corner + Vec3d{0.5, 0.5, 0.5}), side / 2, nullptr);
    }
    for (uint32_t count = 0; !cubes_.empty() && cubes_.top().bound > (1 + kSectionTolerance) * radius_; ++count) {
      if (count % 256 == 0) stopOnly.checkpoint(0);
      const bool isDecided = 2 * radius_ >= search.enough || 2 * cubes_.top().bound < search.enough;
      if (count == maxCubeCount || (isDecided && std::isfinite(search.enough)))
        return {centre_, 2 * radius_, 2 * cubes_.top().bound};
      const Cube cube = cubes_.top();
      cubes_.pop();
      for (uint32_t i = 0; i < 8; ++i) {
        const double half = cube.halfSide / 2;
        add(cube.centre + Vec3d{i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half}, half, &cube.foot);
      }
    }
    return {centre_, 2 * radius_, 2 * (1 + kSectionTolerance) * radius_};
  }

 private:
  /// The ball in the middle of the ray from a face inwards.
  void offerMiddle(uint32_t face) {
    const std::array<Vec3d, 3> corners = surface_.triangle(face).corners;
    const Vec3d start = (corners[0] + corners[1] + corners[2]) / 3.0, inwards = -surface_.normal(face);
    const RayHit hit = surface_.opposite(start + kContactDistance * inwards, inwards);
    if (hit.face != kNoFace) improve(start + 0.5 * (hit.distance + kContactDistance) * inwards);
  }

  /// known: a point of the surface near the cube, or null.
  void add(const Vec3d& centre, double halfSide, const Vec3d* known) {
    const double reach = std::sqrt(3.0) * halfSide;
    const double enough = (1 + kSectionTolerance) * radius_ - reach;
    const double atMost = known != nullptr ? length(centre - *known) : std::numeric_limits<double>::infinity();
    if (atMost < enough) return;
    const SurfacePoint foot = surface_.nearest(centre, enough, atMost);
    if (foot.face == kNoFace || foot.distance < enough) return;
    if (foot.side >= 0) {  // The centre is outside of the solid.
      if (reach - foot.distance > radius_) cubes_.push({centre, halfSide, reach - foot.distance, foot.point});
      return;
    }
    offer(centre, foot.distance);
    double bound = foot.distance + reach;
    if (bound > radius_ && foot.distance > 0) bound = std::min(bound, boundByWalls(centre, foot, reach));
    if (bound > (1 + kSectionTolerance) * radius_) cubes_.push({centre, halfSide, bound, foot.point});
  }

  void offer(const Vec3d& centre, double radius) {
    if (radius <= radius_) return;
    radius_ = radius;
    centre_ = centre;
  }

  /// A bound for balls with centres within `reach` of `centre`, by two points that no ball contains: the foot, and the
  /// point of the wall opposite to the foot.
  double boundByWalls(const Vec3d& centre, const SurfacePoint& foot, double reach) {
    const Vec3d away = (centre - foot.point) / foot.distance;
    const RayHit hit = surface_.opposite(centre, away);
    if (hit.face == kNoFace) return std::numeric_limits<double>::infinity();
    const double half = 0.5 * (foot.distance + hit.distance);
    improve(centre + (half - foot.distance) * away);
    if (half - foot.distance > reach) return std::numeric_limits<double>::infinity();
    const double byPoints = std::sqrt(half * half + reach * reach);
    // A bound by the planes of both walls, if the walls are flat as far as the balls reach.
    const Vec3d &n = surface_.normal(foot.face), &m = surface_.normal(hit.face);
    const double depth = -dot(centre - surface_.triangle(foot.face).corners[0], n);
    const double other = -dot(centre - surface_.triangle(hit.face).corners[0], m);
    const double byPlanes = 0.5 * (depth + other) + 0.5 * reach * length(n + m);
    if (byPlanes >= byPoints || !surface_.isFlatAround(centre + depth * n, reach, foot.face) ||
        !surface_.isFlatAround(centre + other * m, reach, hit.face))
      return byPoints;
    return byPlanes;
  }

  void improve(const Vec3d& centre) {
    const SurfacePoint foot = surface_.nearest(centre);
    if (foot.side < 0) offer(centre, foot.distance);
  }

  const SolidSurface& surface_;
  std::priority_queue<Cube> cubes_;
  double radius_ = 0;
  Vec3d centre_;
};

}  // namespace

std::vector<GreatestSection> findGreatestSections(const TraceScene& scene, std::span<const uint32_t> solidOf,
                                                  std::span<const uint8_t> isWanted, const SectionSearch& search,
                                                  const RunControl& control) {
  const Buckets<uint32_t> copies = groupCopies(scene.representatives);
  std::vector<Box3d> boxes(isWanted.size());
  std::vector<std::vector<uint32_t>> faces(isWanted.size());
  for (uint32_t face = 0; face < scene.mesh.faceCount(); ++face) {
    const uint32_t solid = solidOf[face];
    if (isWanted[solid] == 0 || scene.geometry.isDegenerate(face)) continue;
    faces[solid].push_back(face);
    for (const uint32_t vertex : scene.mesh.faces[face])
      boxes[solid].add(scene.bvh.normalization.toNormalized(scene.mesh.vertices[vertex]));
  }
  const auto wanted = static_cast<uint32_t>(std::count(isWanted.begin(), isWanted.end(), 1));
  const uint32_t maxCubes = std::max(search.cubeCount / std::max(wanted, 1u), kLeastCubeCount);
  std::vector<GreatestSection> sections(isWanted.size());
  for (uint32_t solid = 0; solid < sections.size(); ++solid) {
    control.checkpoint(static_cast<double>(solid) / static_cast<double>(sections.size()));
    if (isWanted[solid] == 0) continue;
    const SolidSurface surface(scene, copies, solidOf, solid);
    sections[solid] = Search(surface).run(boxes[solid], faces[solid], search, maxCubes, control.withoutProgress());
  }
  return sections;
}

}  // namespace asdfvk
