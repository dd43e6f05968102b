#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "trace/cone_tracer.h"

namespace asdfvk::bench {

/// Baseline for the speed of tracers: Embree traces the rays of the cones, and the lengths are added.
class EmbreeBaseline {
 public:
  virtual ~EmbreeBaseline() = default;
  /// A parallel loop of rtcIntersect1 over all rays of the seeds, in the order of the seeds. Rays start at a small
  /// distance from their faces. Returns the sum of the lengths of all rays that hit, in normalised units.
  [[nodiscard]] virtual double trace(std::span<const uint32_t> seedFaces) const = 0;
};

struct EmbreeMode {
  const char* name;
  const char* deviceConfig;  ///< Argument of rtcNewDevice(); may be null.
  bool isRobust;             ///< Watertight. In the fastest mode a ray can pass between two adjacent triangles.
};
inline constexpr EmbreeMode kEmbreeFast{"Embree, fast", nullptr, false};
inline constexpr std::array<EmbreeMode, 3> kEmbreeModes{
    {kEmbreeFast, {"Embree, AVX2", "max_isa=avx2", false}, {"Embree, robust", nullptr, true}}};

/// Builds Embree's scene of medium quality from the given faces. The order of the faces has a small influence on the
/// speed. `scene` and `cone` must outlive the result. Null if the build has no Embree.
[[nodiscard]] std::unique_ptr<EmbreeBaseline> makeEmbreeBaseline(const TraceScene& scene,
                                                                 std::span<const uint32_t> faces, const Cone& cone,
                                                                 const EmbreeMode& mode);

[[nodiscard]] bool hasCgal();

/// Seconds of CGAL's sdf_values() for every face with 30 rays and 120 degrees, without post-processing, on one thread.
/// The conversion to a polyhedron is not included. Unset if the build has no CGAL, or if the mesh is not an orientable
/// 2-manifold.
[[nodiscard]] std::optional<double> cgalSeconds(const Mesh& mesh);

}  // namespace asdfvk::bench
