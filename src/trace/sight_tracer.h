#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/line_segment.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Tests batches of line segments against the faces. Both implementations give the same result where no segment
/// grazes an edge or ends near a face.
class SightTracer {
 public:
  virtual ~SightTracer() = default;

  /// Sets isClear[i] to 1 where no face lies between the ends of segments[i], else to 0. Segments are in the unit of
  /// the mesh; kSightMargin of their length at both ends, at least kContactDistance, is not tested. A segment with a
  /// non-finite end, and one of no length, is clear. Independent of the number of threads.
  virtual void trace(std::span<const LineSegment> segments, std::span<uint8_t> isClear) const = 0;
};
inline constexpr double kSightMargin = 1e-4;

/// Double precision, on all cores of the CPU. The scene, and the nodes of its hierarchy, must outlive it.
[[nodiscard]] std::unique_ptr<SightTracer> makeReferenceSightTracer(const TraceScene& scene);

/// float32 in lanes, on all cores of the CPU; segments that end outside of the box of the mesh are the reference's. The
/// scene, and the nodes of its hierarchy, must outlive it.
[[nodiscard]] std::unique_ptr<SightTracer> makeCpuSightTracer(const TraceScene& scene);

}  // namespace asdfvk
