#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/vec3.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Tests line segments against the faces. Results of implementations may differ only if a segment grazes an edge or
/// ends near a face.
class SightTracer {
 public:
  virtual ~SightTracer() = default;

  /// Sets isClear[i] to 1 if no face is between the ends of segments[i], else to 0. Segments are in the unit of the
  /// mesh. A margin at both ends of a segment is not tested: kSightMargin of its length, but at least kContactDistance
  /// in normalised units. A segment with a non-finite end, or of length 0, is clear. The number of threads has no
  /// effect.
  virtual void trace(std::span<const LineSegment> segments, std::span<uint8_t> isClear) const = 0;
};
inline constexpr double kSightMargin = 1e-4;

/// Double precision, on all cores of the CPU. The scene and the nodes of its hierarchy must outlive the result.
[[nodiscard]] std::unique_ptr<SightTracer> makeReferenceSightTracer(const TraceScene& scene);

/// Float32, in lanes, on all cores of the CPU. The reference tests segments with an end outside of the box of the mesh.
/// The scene and the nodes of its hierarchy must outlive the result.
[[nodiscard]] std::unique_ptr<SightTracer> makeCpuSightTracer(const TraceScene& scene);

}  // namespace asdfvk
