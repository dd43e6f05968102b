#pragma once

#include <memory>
#include <span>

#include "trace/cone_tracer.h"

namespace asdfvk::bench {

/// What Embree does with the rays of cones when nothing but their lengths is added up: the measure of a tracer. The
/// scene and the cone must outlive it.
class BareEmbree {
 public:
  virtual ~BareEmbree() = default;
  /// A plain parallel loop of rtcIntersect1 over every ray of the seeds, in the order given, each begun a little off
  /// its face. Returns the sum of the lengths of those that hit, in normalised units.
  [[nodiscard]] virtual double trace(std::span<const uint32_t> seedFaces) const = 0;
};

enum class BareMode {
  Fastest,  ///< A ray may fall between two triangles.
  Robust,   ///< None does; our own tracer takes it for surfaces that rays leave often.
};

/// Builds Embree's scene, at medium quality. faces: those that can be hit, once each, in the order in which Embree is
/// given them, which its time depends on a little. Null where this build has no Embree.
[[nodiscard]] std::unique_ptr<BareEmbree> makeBareEmbree(const TraceScene& scene, std::span<const uint32_t> faces,
                                                         const Cone& cone, BareMode mode);

}  // namespace asdfvk::bench
