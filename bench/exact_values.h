#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cone/cone.h"
#include "generate/generated_shape.h"

namespace asdfvk::bench {

struct TracedFace {
  Vec3d barycentre, normal;
  double value = kNoValue;  ///< In the mesh's unit.
};

/// The exact value at a face. The value is discontinuous where a ray becomes a false intersection or an outlier; the
/// margins are the distances to the nearest such threshold.
struct ExactValue {
  double value = kNoValue;
  double cosineMargin = 0;  ///< Of the cosine of the angle between the normals at both ends of a ray.
  double lengthMargin = 0;  ///< Of a ray's length, in the shape's unit.
};

/// Upper bounds of the differences between a mesh and its smooth shape in the quantities that have margins.
struct Deviation {
  double cosine = 0, length = 0;
};

/// A smooth shape with known values, and meshes of it at any resolution.
struct AnalyticShape {
  std::string title;
  std::function<GeneratedShape(uint64_t faceCount)> makeMesh;
  std::function<ExactValue(const TracedFace&)> exactValue;
  std::function<bool(const Vec3d& barycentre)> hasExactValue;
  std::function<Vec3d(const Vec3d& point)> smoothNormal;
  double radius = 0;            ///< Of curvature; 0: flat.
  bool usesFaceNormal = false;  ///< The axis of the exact cone is the normal of the flat face, not the smooth normal.
};

/// Sphere, slab and long cylinder.
[[nodiscard]] std::vector<AnalyticShape> analyticShapes(const ConeOptions& cone);

/// Greatest angle in radians between the normal of a face that rays can hit and the smooth normals at its corners.
[[nodiscard]] double facetAngle(const AnalyticShape& shape, const Mesh& mesh);

[[nodiscard]] Deviation deviationAt(const AnalyticShape& shape, const TracedFace& face, double facetAngle,
                                    const ConeOptions& cone);

}  // namespace asdfvk::bench
