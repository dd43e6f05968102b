#include "mesh/arc_angles.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/lane_vec3.h"
#include "core/parallel.h"
#include "core/prefetch.h"

namespace asdfvk {
namespace {

/// The angle between two normals by the square of its sine and its cosine, and whether the edge is concave.
template <typename Real>
struct Dihedral {
  using Mask = decltype(Real{} < Real{});

  Real sineSquared, cosine;
  Mask isConcave;
};

template <typename Vector>
ASDFVK_ALWAYS_INLINE inline auto dihedral(const Vector& normalF, const Vector& normalG, const Vector& barycentreF,
                                          const Vector& barycentreG) {
  const Vector normal = cross(normalF, normalG);
  // The barycentres are halved, so that their difference does not overflow.
  const Vector between = barycentreG * 0.5 - barycentreF * 0.5;
  using Result = Dihedral<decltype(dot(normal, normal))>;
  // No branch, because the processor cannot predict the conditions.
  const typename Result::Mask isAboveF = dot(normalF, between) > 0, isAboveG = dot(normalG, between) < 0;
  // At a degenerate face, the sine is 0 and the cosine is 0 or -0. With the cosine -0, the angle would be pi instead of
  // 0. The addition of 0 turns -0 into 0.
  return Result{dot(normal, normal), dot(normalF, normalG) + 0.0,
                static_cast<typename Result::Mask>(isAboveF & isAboveG)};
}

// The arc tangent is accurate for small angles, unlike the arc cosine.
double arcTangent(double sine, double cosine) { return std::atan2(sine, cosine); }

/// The angles between faces and neighbours, rounded to float. Small angles use a power series, which is faster. Where
/// the error of the series could change the rounded result, the arc tangent is used.
ASDFVK_ALWAYS_INLINE inline void setAngles(const FaceGeometry& geometry, const LaneIndices& faces,
                                           const LaneIndices& neighbours, std::span<float> angles) {
  constexpr double kMaxTangent = 0.25, kMaxError = 1e-11;  // The first omitted term is below 1e-12 of the angle.
  const auto [sineSquared, cosine, isConcave] =
      dihedral(gather(geometry.normals.data(), faces), gather(geometry.normals.data(), neighbours),
               gather(geometry.barycentres.data(), faces), gather(geometry.barycentres.data(), neighbours));
  const Double4 sine = squareRoots(sineSquared), t = sine / cosine, s = t * t;
  Double4 series{};
  for (int k = 17; k > 1; k -= 2) series = s * (1.0 / k - series);
  const Double4 angle = t - t * series, low = angle * (1 - kMaxError), high = angle * (1 + kMaxError);
  for (size_t lane = 0; lane < angles.size(); ++lane) {
    float rounded = static_cast<float>(low[lane]);
    // False for degenerate faces, whose normals are zero.
    const bool isExact = sine[lane] < kMaxTangent * cosine[lane] && rounded == static_cast<float>(high[lane]);
    if (!isExact) rounded = static_cast<float>(arcTangent(sine[lane], cosine[lane]));
    angles[lane] = isConcave[lane] != 0 ? rounded : -rounded;
  }
}

/// Sets the angles of all arcs that begin at the faces firstFace to endFace - 1. The angle between two faces is
/// computed twice, once per direction, because finding the arc of the opposite direction takes longer.
ASDFVK_ALWAYS_INLINE inline void setAnglesFrom(uint32_t firstFace, uint32_t endFace, const DualGraph& graph,
                                               const FaceGeometry& geometry, std::span<float> angles) {
  constexpr size_t kLanes = kLaneCount<Double4>, kPrefetchDistance = 16;  // Unit: arcs.
  const size_t end = graph.offsets[endFace];
  uint32_t face = firstFace;
  for (size_t arc = graph.offsets[firstFace]; arc < end; arc += kLanes) {
    LaneIndices faces, neighbours;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const size_t own = std::min(arc + lane, end - 1);  // Lanes beyond the end repeat the last arc.
      const uint32_t later = graph.neighbours[std::min(own + kPrefetchDistance, end - 1)];
      prefetchMemory(&geometry.normals[later]);
      prefetchMemory(&geometry.barycentres[later]);
      while (graph.offsets[face + 1] <= own) ++face;
      faces[lane] = face;
      neighbours[lane] = graph.neighbours[own];
    }
    setAngles(geometry, faces, neighbours, angles.subspan(arc, std::min(kLanes, end - arc)));
  }
}

}  // namespace

double signedDihedralAngle(const FaceGeometry& geometry, uint32_t f, uint32_t g) {
  const auto [sineSquared, cosine, isConcave] =
      dihedral(geometry.normals[f], geometry.normals[g], geometry.barycentres[f], geometry.barycentres[g]);
  const double angle = arcTangent(std::sqrt(sineSquared), cosine);
  return isConcave ? angle : -angle;
}

UnsetVector<float> arcAngles(const DualGraph& graph, const FaceGeometry& geometry, InstructionSet instructionSet) {
  ASDFVK_CHECK_OP(geometry.areas.size(), ==, size_t{graph.faceCount()});
  UnsetVector<float> angles(graph.neighbours.size());
  forEachRange(graph.faceCount(), kItemsPerTask / 4, [&](size_t begin, size_t end) {
    dispatch<Float8>(instructionSet, [&]<typename>() ASDFVK_ALWAYS_INLINE {
      setAnglesFrom(static_cast<uint32_t>(begin), static_cast<uint32_t>(end), graph, geometry, angles);
    });
  });
  return angles;
}

}  // namespace asdfvk
