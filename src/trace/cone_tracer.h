#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "asdf_vk/run_control.h"
#include "bvh/bvh.h"
#include "cone/cone.h"
#include "core/check.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "shared/cone_hit.h"

namespace asdfvk {

/// What cones are traced against. Views only: everything must outlive the tracer.
struct TraceScene {
  TriangleMesh mesh;
  const FaceGeometry& geometry;
  std::span<const uint32_t> representatives;  ///< #F, see coincidentRepresentatives().
  const Bvh& bvh;
};

struct TraceStatistics {
  uint64_t rayCount = 0;
  uint64_t redoneConeCount =
      0;  ///< Cones that the reference traced instead of a device: beyond its iterations or float32.
};

/// Where the results of N cones of R rays go.
struct ConeResults {
  std::span<double> values;  ///< N.
  /// What each ray met, valid or not: empty when nobody asks, else N R, ray r of cone i (in the order of
  /// Cone::directions) at i R + r. A false intersection is reported with its face; isFalseHit() tells.
  std::span<ConeHit> hits = {};
};

inline constexpr ConeHit kMiss{std::bit_cast<float>(kMissDistanceBits), kNoFace};

/// Throws CheckFailure when the results have no room for so many cones.
inline void checkSizes(const ConeResults& results, size_t coneCount, size_t rayCount) {
  ASDFVK_CHECK_OP(results.values.size(), ==, coneCount);
  if (!results.hits.empty()) ASDFVK_CHECK_OP(results.hits.size(), ==, coneCount * rayCount);
}

/// A way to trace cones. All of them share one accept rule: the nearest hit that is not on the seed face itself or a
/// copy of it; dropped when that hit is false (see isFalseHit()) or nothing is hit.
class ConeTracer {
 public:
  virtual ~ConeTracer() = default;

  /// results.values[i] becomes the shape diameter at seedFaces[i] in the mesh's unit, or kNoValue when no ray of its
  /// cone is valid; it has the same bits whether hits are asked for or not. Precondition: no seed face is degenerate.
  /// Throws Error{Cancelled} between chunks, Error{Device}.
  virtual TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                                const RunControl& control) = 0;

  /// Of what making it took, the seconds that went by before anything was brought to a device; 0 without one.
  [[nodiscard]] virtual double encodeSeconds() const { return 0; }
};

}  // namespace asdfvk
