#include "exact_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "generate/analytic_shapes.h"
#include "mesh/face_geometry.h"
#include "shared/cone_rules.h"

namespace asdfvk::bench {
namespace {

constexpr SphereParameters kSphere;
constexpr SlabParameters kSlab;
constexpr CylinderParameters kCylinder;

// Rounding to float32 adds this to every deviation.
constexpr double kRoundingSlack = 1e-6;

double halfAngleRadians(const ConeOptions& cone) { return cone.openingAngleDegrees / 2 * std::numbers::pi / 180; }

double angleBetween(const Vec3d& a, const Vec3d& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

double medianOf(std::vector<double> lengths) {
  std::sort(lengths.begin(), lengths.end());
  return 0.5 * (lengths[(lengths.size() - 1) / 2] + lengths[lengths.size() / 2]);
}

double standardDeviationOf(const std::vector<double>& lengths) {
  double sum = 0, squares = 0;
  for (const double length : lengths) sum += length;
  const double mean = sum / static_cast<double>(lengths.size());
  for (const double length : lengths) squares += (length - mean) * (length - mean);
  return std::sqrt(squares / static_cast<double>(lengths.size()));
}

struct ExactHit {
  double length = 0;
  double normalCosine = 0;  // Of the angle between the normals at both ends.
};

/// A second implementation of the definition, from the directions to the weighted mean, so that exact values share only
/// the frame of a face with the code under test.
class ExactCone {
 public:
  explicit ExactCone(const ConeOptions& options) {
    const double halfAngle = halfAngleRadians(options);
    for (uint32_t i = 0; i < options.rayCount; ++i) {
      const double t = std::acos(1 - (i + 0.5) / options.rayCount * (1 - std::cos(halfAngle)));
      const double phi = i * std::numbers::pi * (3 - std::sqrt(5.0));
      directions_.push_back({std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t)});
      weights_.push_back(1 / t);
    }
  }

  /// From any point of a sphere along its normal: chords of length 2 radius cos t.
  [[nodiscard]] ExactValue onSphere(double radius) const {
    // The arc between the ends of a chord is pi - 2 t.
    return valueOf([&](const Vec3d& direction) {
      return ExactHit{2 * radius * direction.z, 1 - 2 * direction.z * direction.z};
    });
  }

  /// Between two parallel planes: thickness / cos t.
  [[nodiscard]] ExactValue inSlab(double thickness) const {
    return valueOf([&](const Vec3d& direction) { return ExactHit{thickness / direction.z, -1}; });
  }

  /// In an infinite cylinder around z, from its point nearest to `barycentre`, in the frame of a face with that normal.
  [[nodiscard]] ExactValue inCylinder(double radius, const Vec3d& barycentre, const Vec3d& normal) const {
    const ConeFrame frame = coneFrame(-normal);
    const Vec3d from = Vec3d{barycentre.x, barycentre.y, 0} * (radius / std::hypot(barycentre.x, barycentre.y));
    return valueOf([&](const Vec3d& direction) {
      const Vec3d d = frame.tangent * direction.x + frame.bitangent * direction.y + frame.axis * direction.z;
      const double length = -2 * dot(from, d) / (d.x * d.x + d.y * d.y);
      const Vec3d hit = from + d * length;
      return ExactHit{length, dot(Vec3d{hit.x, hit.y, 0} / radius, normal)};
    });
  }

 private:
  /// hitOf: from a direction in the cone's frame, whose axis is z, to an ExactHit.
  template <typename HitOf>
  [[nodiscard]] ExactValue valueOf(const HitOf& hitOf) const {
    ExactValue exact{kNoValue, 1, std::numeric_limits<double>::infinity()};
    std::vector<double> lengths, weights;
    for (size_t i = 0; i < directions_.size(); ++i) {
      const ExactHit hit = hitOf(directions_[i]);
      exact.cosineMargin = std::min(exact.cosineMargin, std::abs(hit.normalCosine - kFalseHitSlack));
      if (hit.normalCosine > kFalseHitSlack) continue;
      lengths.push_back(hit.length);
      weights.push_back(weights_[i]);
    }
    if (lengths.empty()) return exact;
    const double median = medianOf(lengths);
    const double bound = standardDeviationOf(lengths) + kOutlierSlack * median;
    double sum = 0, weightSum = 0;
    for (size_t i = 0; i < lengths.size(); ++i) {
      const double excess = std::abs(lengths[i] - median) - bound;
      exact.lengthMargin = std::min(exact.lengthMargin, std::abs(excess));
      if (excess > 0) continue;
      sum += weights[i] * lengths[i];
      weightSum += weights[i];
    }
    exact.value = sum / weightSum;
    return exact;
  }

  std::vector<Vec3d> directions_;
  std::vector<double> weights_;
};

AnalyticShape sphere(const ExactCone& exact) {
  return {fmt::format("sphere, radius {}: chords 2 R cos t", kSphere.radius),
          [](uint64_t faceCount) { return makeIcosphere(faceCount, kSphere); },
          [exact](const TracedFace&) { return exact.onSphere(kSphere.radius); },
          [](const Vec3d&) { return true; },
          [](const Vec3d& p) { return p / length(p); },
          kSphere.radius,
          false};
}

// reach: greatest distance of the ends of a ray along x and y.
AnalyticShape slab(const ExactCone& exact, double reach) {
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

// reach: greatest distance of the ends of a ray along z.
AnalyticShape cylinder(const ExactCone& exact, double reach) {
  return {fmt::format("cylinder, radius {}, length {}, faces {:.2f} from the caps: rays in an infinite one",
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

std::vector<AnalyticShape> analyticShapes(const ConeOptions& cone) {
  const ExactCone exact(cone);
  // 1.1: the facets of a mesh lie a little off the smooth shape.
  const double slope = 1.1 * std::tan(halfAngleRadians(cone));
  return {sphere(exact), slab(exact, kSlab.thickness * slope), cylinder(exact, 2 * kCylinder.radius * slope)};
}

double facetAngle(const AnalyticShape& shape, const Mesh& mesh) {
  if (shape.radius == 0) return 0;
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  double angle = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    if (shape.hasExactValue(geometry.barycentres[face]))
      for (const uint32_t vertex : mesh.faces[face])
        angle = std::max(angle, angleBetween(geometry.normals[face], shape.smoothNormal(mesh.vertices[vertex])));
  return angle;
}

Deviation deviationAt(const AnalyticShape& shape, const TracedFace& face, double facetAngle, const ConeOptions& cone) {
  const double axisAngle = shape.usesFaceNormal ? 0 : angleBetween(face.normal, shape.smoothNormal(face.barycentre));
  // Both ends of a ray lie up to `depth` below the smooth surface, and the cone is tilted by axisAngle. The ray's
  // length, the median and the standard deviation each deviate by at most `ray`.
  const double depth = shape.radius * (1 - std::cos(facetAngle));
  const double ray = 2 * depth / std::cos(halfAngleRadians(cone)) + 2 * shape.radius * axisAngle;
  return {facetAngle + 3 * axisAngle + kRoundingSlack, 3 * ray + kRoundingSlack};
}

}  // namespace asdfvk::bench
