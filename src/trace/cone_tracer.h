#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "asdf_vk/run_control.h"
#include "cone/cone.h"
#include "core/check.h"
#include "shared/cone_hit.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// The frame of the rays of a face, as Cone::definition selects it. Precondition: the face is not degenerate.
[[nodiscard]] ConeFrame seedConeFrame(const TraceScene& scene, const Cone& cone, uint32_t face);

/// Place and frame of the rays of one cone.
struct ConeStart {
  Vec3d origin;                    ///< Start of the rays, in normalised coordinates.
  Vec3d normal;                    ///< Unit, outwards; the false hits of Definition::Paper refer to it.
  ConeFrame frame;                 ///< The axis is minus the normal.
  uint32_t skippedFace = kNoFace;  ///< Hits on this representative are ignored.
};

/// The cone of a face: from its barycentre, without hits on the face and its copies. Precondition: the face is not
/// degenerate.
[[nodiscard]] inline ConeStart coneStartOfFace(const TraceScene& scene, const Cone& cone, uint32_t face) {
  return {scene.originOf(face), scene.geometry.normals[face], seedConeFrame(scene, cone, face),
          scene.representatives[face]};
}

/// A cone from any origin; its rays may hit every face. normal: unit. ConeRotation::Hashed turns it by a hash of the
/// origin.
[[nodiscard]] ConeStart coneStartAt(const Cone& cone, const Vec3d& origin, const Vec3d& normal);

struct TraceStatistics {
  uint64_t rayCount = 0;
  /// Cones that the reference traced instead, because the device reached its iteration limit or the cone is too small
  /// for float32.
  uint64_t redoneConeCount = 0;
};

/// Output arrays for N cones of R rays.
struct ConeResults {
  std::span<double> values;  ///< N.
  /// The nearest hit of each ray, rejected hits included: N x R, ray r of cone i (in the order of Cone::directions) at
  /// i R + r. Empty: hits are not written.
  std::span<ConeHit> hits = {};
};

inline constexpr ConeHit kMiss{std::bit_cast<float>(kMissDistanceBits), kNoFace};

/// Throws CheckFailure when the sizes of the results do not match.
inline void checkSizes(const ConeResults& results, size_t coneCount, size_t rayCount) {
  ASDFVK_CHECK_OP(results.values.size(), ==, coneCount);
  if (!results.hits.empty()) ASDFVK_CHECK_OP(results.hits.size(), ==, coneCount * rayCount);
}

/// Traces batches of cones. Every implementation has the same rule: a ray ends at the nearest hit that is not on the
/// seed face or a copy of it. The ray is valid if there is such a hit and it is not false (see isFalseHit()).
class ConeTracer {
 public:
  virtual ~ConeTracer() = default;

  /// Sets results.values[i] to the shape diameter at seedFaces[i] in the mesh's unit, or to kNoValue if no ray of its
  /// cone is valid. Values have the same bits with and without hits. Precondition: no seed face is degenerate.
  /// Throws Error{Cancelled} between chunks, Error{Device}.
  virtual TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                                const RunControl& control) = 0;

  /// Like trace() for cones from any origins. Precondition: the origins are finite. A cone of coneStartOfFace() has the
  /// value that trace() gives its face, up to rounding.
  virtual TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                                  const RunControl& control) = 0;

  /// Seconds that the constructor spent on encoding the hierarchy for a device, without the upload; 0 without a device.
  [[nodiscard]] virtual double encodeSeconds() const { return 0; }
};

/// Double precision, watertight, on all cores of the CPU: the other tracers are compared with it. Values do not depend
/// on the number of threads.
[[nodiscard]] std::unique_ptr<ConeTracer> makeReferenceTracer(const TraceScene& scene, const Cone& cone);

/// Traces in float32, in lanes (trace/cpu/ray_walk.h), on all cores of the CPU; lengths are recomputed in double.
/// Values do not depend on the number of threads, nor on the instruction set. Cones too small for float32 are traced by
/// the reference. The nodes of the hierarchy are not used after the call; the rest of the scene and the cone must
/// outlive the tracer.
[[nodiscard]] std::unique_ptr<ConeTracer> makeCpuTracer(const TraceScene& scene, const Cone& cone);

// In normalised units. Tracers in float32 (resolution 2^-24 at the rim of the bounding box) delegate two kinds of cones
// to the reference. The first are cones of faces with an area below kMinFloatFace^2, the second are cones with a value
// below kMinFloatDiameter.
inline constexpr double kMinFloatFace = 0x1p-16;
inline constexpr double kMinFloatDiameter = 0x1p-14;

[[nodiscard]] inline bool isTooSmallForFloat(const TraceScene& scene, uint32_t seedFace) {
  const double scale = scene.bvh.normalization.scale;
  return scene.geometry.areas[seedFace] * scale * scale < kMinFloatFace * kMinFloatFace;
}

/// Whether a point is in the normalised box [-1, 1]^3 or near it. The traversals require this of the origins of rays.
/// The reference traces the other cones, from the points where their rays enter the box.
[[nodiscard]] inline bool isNearBox(const Vec3d& origin) {
  constexpr double kNearBox = 1 + 0x1p-6;
  return std::abs(origin.x) <= kNearBox && std::abs(origin.y) <= kNearBox && std::abs(origin.z) <= kNearBox;
}

}  // namespace asdfvk
