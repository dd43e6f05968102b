#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cone/cone.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// All rays of some seeds and what they met.
struct TracedCones {
  std::span<const uint32_t> seeds;  ///< #S
  std::span<const ConeHit> hits;    ///< #S x rays, as ConeResults::hits.
};

/// Per cone: which lengths its outlier rule keeps, in normalised units. #S.
[[nodiscard]] std::vector<LengthWindow> keptLengths(const TraceScene& scene, const Cone& cone,
                                                    const TracedCones& traced);

/// Runs of as many numbers are computed side by side; a cone's rays are padded to whole runs.
inline constexpr size_t kHitRun = 8;

/// The points that the rays of a few seeds met, as arrays, so that compilers compute them eight at a time. All arrays
/// have cones x raysPerCone() entries. In normalised units.
class GatheredHits {
 public:
  GatheredHits(const TraceScene& scene, const Cone& cone, const TracedCones& traced,
               std::span<const LengthWindow> windows);

  /// Replaces what was gathered by the hits of these cones, indices into the seeds.
  void gather(std::span<const uint32_t> cones);

  [[nodiscard]] size_t raysPerCone() const { return raysPerCone_; }  ///< A multiple of kHitRun.
  [[nodiscard]] size_t size() const { return x.size(); }

  std::vector<float> x, y, z;     ///< Where; NaN for a ray that met nothing, and for padding.
  std::vector<float> nx, ny, nz;  ///< The unit normal there.
  std::vector<float> spread;      ///< length^2 / (cosine of incidence + kGrazingSlack): the area a ray stands for.
  std::vector<float> kept;        ///< 1 where the seed's own outlier rule keeps the ray, else 0.
  std::vector<uint32_t> face;     ///< The face hit.

 private:
  void put(size_t at, const ConeHit& hit, uint32_t seedFace, const ConeFrame& frame, const Vec3d& local,
           const LengthWindow& window);

  const TraceScene& scene_;
  const Cone& cone_;
  TracedCones traced_;
  std::span<const LengthWindow> windows_;
  size_t raysPerCone_;
};

/// Keeps the area of a ray that grazes a face finite.
inline constexpr float kGrazingSlack = 0.05f;

}  // namespace asdfvk
