#include "analytic_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/analytic_shapes.h"
#include "mesh/face_geometry.h"

namespace asdfvk::bench {
namespace {

constexpr SphereParameters kSphere;
constexpr SlabParameters kSlab;
constexpr CylinderParameters kCylinder;

// What float32 adds to every deviation.
constexpr double kRoundingSlack = 1e-6;

double halfAngleRadians(const ConeOptions& cone) { return cone.openingAngleDegrees / 2 * std::numbers::pi / 180; }

double angleBetween(const Vec3d& a, const Vec3d& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

AnalyticFamily sphere(const ExactCone& exact) {
  return {fmt::format("sphere, radius {}: chords 2 R cos t", kSphere.radius),
          [](uint64_t faceCount) { return makeIcosphere(faceCount, kSphere); },
          [exact](const TracedFace&) { return exact.onSphere(kSphere.radius); },
          [](const Vec3d&) { return true; },
          [](const Vec3d& p) { return p / length(p); },
          kSphere.radius,
          false};
}

// `reach`: how far along x and y a ray can get before it is on the other side.
AnalyticFamily slab(const ExactCone& exact, double reach) {
  return {fmt::format("slab, {} x {} x {}, faces {:.2f} from the rim: thickness / cos t", kSlab.width, kSlab.width,
                      kSlab.thickness, reach),
          [](uint64_t faceCount) { return makeSlab(faceCount, kSlab); },
          [exact](const TracedFace&) { return exact.inSlab(kSlab.thickness); },
          [reach](const Vec3d& p) { return std::max(std::abs(p.x), std::abs(p.y)) < kSlab.width / 2 - reach; },
          [](const Vec3d& p) {
            return Vec3d{0, 0, p.z > 0 ? 1.0 : -1.0};
          },
          0,
          false};
}

// `reach`: how far along z a ray can get before it is on the other side.
AnalyticFamily cylinder(const ExactCone& exact, double reach) {
  return {fmt::format("cylinder, radius {}, length {}, faces {:.2f} from the caps: rays in an endless one",
                      kCylinder.radius, kCylinder.length, reach),
          [](uint64_t faceCount) { return makeCylinder(faceCount, kCylinder); },
          [exact](const TracedFace& face) { return exact.inCylinder(kCylinder.radius, face.barycentre, face.normal); },
          [reach](const Vec3d& p) { return std::abs(p.z) < kCylinder.length / 2 - reach; },
          [](const Vec3d& p) {
            return Vec3d{p.x, p.y, 0} / std::hypot(p.x, p.y);
          },
          kCylinder.radius,
          true};
}

}  // namespace

std::vector<AnalyticFamily> analyticFamilies(const ConeOptions& cone) {
  const ExactCone exact(cone);
  // A tenth more than the farthest that a ray can get, because facets lie a little off the shape.
  const double slope = 1.1 * std::tan(halfAngleRadians(cone));
  return {sphere(exact), slab(exact, kSlab.thickness * slope), cylinder(exact, 2 * kCylinder.radius * slope)};
}

double facetAngleOf(const AnalyticFamily& family, const Mesh& mesh) {
  if (family.radius == 0) return 0;
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  double angle = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    if (family.wanted(geometry.barycentres[face]))
      for (const uint32_t vertex : mesh.faces[face])
        angle = std::max(angle, angleBetween(geometry.normals[face], family.smoothNormal(mesh.vertices[vertex])));
  return angle;
}

Deviation deviationAt(const AnalyticFamily& family, const TracedFace& face, double facetAngle,
                      const ConeOptions& cone) {
  const double axisAngle = family.usesFaceNormal ? 0 : angleBetween(face.normal, family.smoothNormal(face.barycentre));
  // Both ends of a ray lie up to `depth` beneath the surface, and its cone leans by axisAngle. The length, the median
  // and the standard deviation that it is held against can each be off by as much.
  const double depth = family.radius * (1 - std::cos(facetAngle));
  const double ray = 2 * depth / std::cos(halfAngleRadians(cone)) + 2 * family.radius * axisAngle;
  return {facetAngle + 3 * axisAngle + kRoundingSlack, 3 * ray + kRoundingSlack};
}

}  // namespace asdfvk::bench
