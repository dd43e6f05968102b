#pragma once

#include <functional>
#include <string>
#include <vector>

#include "exact_cone.h"
#include "generate/generated_shape.h"
#include "traced_sample.h"

namespace asdfvk::bench {

/// A shape at any resolution with the exact value at its faces.
struct AnalyticFamily {
  std::string title;
  std::function<GeneratedShape(uint64_t faceCount)> make;
  std::function<ExactValue(const TracedFace&)> exactValue;
  std::function<bool(const Vec3d& barycentre)> wanted;    ///< The faces that the exact value holds for.
  std::function<Vec3d(const Vec3d& point)> smoothNormal;  ///< Of the surface that the mesh stands for.
  double radius = 0;                                      ///< Of its curvature; 0: flat.
  bool usesFaceNormal = false;  ///< The exact value is for the axis of the flat face, not for the surface's.
};

/// Sphere, slab and long cylinder.
[[nodiscard]] std::vector<AnalyticFamily> analyticFamilies(const ConeOptions& cone);

/// The greatest angle between the normal of a facet that rays may hit and the surface's normal at its corners, in
/// radians.
[[nodiscard]] double facetAngleOf(const AnalyticFamily& family, const Mesh& mesh);

/// How much flat facets can change what the exact value at a face is decided by.
struct Deviation {
  double cosine = 0;  ///< Of the angle between the normals at both ends of a ray.
  double length = 0;  ///< Of a length against the bounds of what is kept, in the shape's unit.
};
[[nodiscard]] Deviation deviationAt(const AnalyticFamily& family, const TracedFace& face, double facetAngle,
                                    const ConeOptions& cone);

}  // namespace asdfvk::bench
