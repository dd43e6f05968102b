#pragma once

#include <memory>
#include <optional>
#include <span>

#include "trace/cone_tracer.h"

/// Other libraries that asdf-vk is compared with. Both are optional at build time.
namespace asdfvk::bench {

/// Embree with the rays of cones and no further work than the sum of their lengths: the reference speed of tracers.
class EmbreeBaseline {
 public:
  virtual ~EmbreeBaseline() = default;
  /// A parallel loop of rtcIntersect1 over every ray of the seeds, in their order. A ray starts a little off its face.
  /// Returns the sum of the lengths of the rays that hit, in normalised units.
  [[nodiscard]] virtual double trace(std::span<const uint32_t> seedFaces) const = 0;
};

enum class EmbreeMode {
  Fast,    ///< A ray can pass between two adjacent triangles.
  Robust,  ///< Watertight.
};

/// Builds Embree's scene of the given faces at medium quality; their order has a small influence on its speed. The
/// scene and the cone must outlive the result. Null without Embree.
[[nodiscard]] std::unique_ptr<EmbreeBaseline> makeEmbreeBaseline(const TraceScene& scene,
                                                                 std::span<const uint32_t> faces, const Cone& cone,
                                                                 EmbreeMode mode);

/// Whether this build has CGAL.
[[nodiscard]] bool hasCgal();

/// Seconds of CGAL's sdf_values() for every face with 30 rays and 120 degrees, without post-processing, on one thread.
/// The conversion to a polyhedron is not included. None without CGAL, and for a mesh that is not an orientable
/// 2-manifold.
[[nodiscard]] std::optional<double> cgalSeconds(const Mesh& mesh);

}  // namespace asdfvk::bench
