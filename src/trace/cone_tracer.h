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
#include "trace/cone_start.h"
#include "trace/device_hits.h"
#include "trace/trace_scene.h"

namespace asdfvk {

struct TraceStatistics {
  uint64_t rayCount = 0;
  /// Cones that the reference traced, because they exceeded the iteration limit of the device or were too small for
  /// float32.
  uint64_t redoneConeCount = 0;
};

struct ConeResults {
  std::span<double> values;  ///< N entries, one per cone.
  /// The nearest hit of each ray, rejected hits included. N * R entries for N cones of R rays: ray r of cone i has the
  /// index i * R + r. Rays are in the order of Cone::directions. Empty: hits are not written.
  std::span<ConeHit> hits = {};
  /// If set, hits are added to it instead. Precondition: the tracer made it, and it has room.
  DeviceHits* onDevice = nullptr;
};

inline constexpr ConeHit kMiss{std::bit_cast<float>(kMissDistanceBits), kNoFace};

inline void checkSizes(const ConeResults& results, size_t coneCount, size_t rayCount) {
  ASDFVK_CHECK_OP(results.values.size(), ==, coneCount);
  if (!results.hits.empty()) ASDFVK_CHECK_OP(results.hits.size(), ==, coneCount * rayCount);
}

/// Traces batches of cones. In every implementation, a ray ends at the nearest hit on a face other than the seed face
/// and its copies. A ray is valid if this hit exists and is not false (isFalseHit()).
class ConeTracer {
 public:
  virtual ~ConeTracer() = default;

  /// Sets results.values[i] to the shape diameter at seedFaces[i] in the mesh's unit, or to kNoValue without a valid
  /// ray. Values have the same bits whether results.hits is empty or not. Precondition: no seed face is degenerate.
  /// Throws Error{Cancelled} between chunks, Error{Device}.
  virtual TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                                const RunControl& control) = 0;

  /// Like trace() for cones from any finite origins. Up to rounding, cones of coneStartOfFace() have the values of
  /// trace().
  virtual TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                                  const RunControl& control) = 0;

  /// Memory on the device for hits; null without a device.
  [[nodiscard]] virtual std::unique_ptr<DeviceHits> makeDeviceHits() const { return nullptr; }

  /// Seconds that the constructor took to encode the nodes of the hierarchy for a device. Its triangles are encoded
  /// during the upload. 0 without a device.
  [[nodiscard]] virtual double encodeSeconds() const { return 0; }
};

/// Makes the reference for the other tracers: double precision, watertight, on all cores of the CPU. Values do not
/// depend on the number of threads.
[[nodiscard]] std::unique_ptr<ConeTracer> makeReferenceTracer(const TraceScene& scene, const Cone& cone);

/// Traces in float32, in lanes (trace/cpu/ray_walk.h), on all cores of the CPU; recomputes lengths in double. Values
/// depend neither on the number of threads nor on the instruction set. The reference traces cones too small for
/// float32. The nodes of the hierarchy are not used after the call; the other data of the scene, and the cone, must
/// outlive the tracer.
[[nodiscard]] std::unique_ptr<ConeTracer> makeCpuTracer(const TraceScene& scene, const Cone& cone);

// In normalised units. Tracers in float32 (resolution 2^-24 at the rim of the bounding box) delegate cones to the
// reference if the area of the face is below kMinFloatFace^2, or if the value is below kMinFloatDiameter.
inline constexpr double kMinFloatFace = 0x1p-16;
inline constexpr double kMinFloatDiameter = 0x1p-14;

[[nodiscard]] inline bool isTooSmallForFloat(const TraceScene& scene, uint32_t seedFace) {
  const double scale = scene.bvh.normalization.scale;
  return scene.geometry.areas[seedFace] * scale * scale < kMinFloatFace * kMinFloatFace;
}

/// Whether a point is in the normalised box [-1, 1]^3 or near the box. Traversals require such origins. For other
/// origins, the reference traces the rays from the points where they enter the box.
[[nodiscard]] inline bool isNearBox(const Vec3d& origin) {
  constexpr double kNearBox = 1 + 0x1p-6;
  return std::abs(origin.x) <= kNearBox && std::abs(origin.y) <= kNearBox && std::abs(origin.z) <= kNearBox;
}

}  // namespace asdfvk
