#pragma once

#include <memory>
#include <optional>
#include <span>

#include "trace/cone_tracer.h"

namespace asdfvk::bench {

/// Embree traces the rays of the cones, and the lengths are added. This speed is the reference for tracers.
class EmbreeBaseline {
 public:
  virtual ~EmbreeBaseline() = default;
  /// A parallel loop of rtcIntersect1 over every ray of the seeds, in their order. Rays start slightly off their faces.
  /// Returns the sum of the lengths of the rays that hit, in normalised units.
  [[nodiscard]] virtual double trace(std::span<const uint32_t> seedFaces) const = 0;
};

enum class EmbreeMode {
  Fast,    ///< A ray can pass between two adjacent triangles.
  Robust,  ///< Watertight.
};

/// Builds Embree's scene of the given faces at medium quality. The order of the faces has a small influence on the
/// speed. `scene` and `cone` must outlive the result. Null without Embree.
[[nodiscard]] std::unique_ptr<EmbreeBaseline> makeEmbreeBaseline(const TraceScene& scene,
                                                                 std::span<const uint32_t> faces, const Cone& cone,
                                                                 EmbreeMode mode);

[[nodiscard]] bool hasCgal();

/// Seconds of CGAL's sdf_values() for every face with 30 rays and 120 degrees, without post-processing, on one thread.
/// Does not include the conversion to a polyhedron. Unset without CGAL, or if the mesh is no orientable 2-manifold.
[[nodiscard]] std::optional<double> cgalSeconds(const Mesh& mesh);

}  // namespace asdfvk::bench
