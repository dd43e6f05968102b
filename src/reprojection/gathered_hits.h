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

/// Neither a miss nor a false intersection.
[[nodiscard]] bool isValidHit(const TraceScene& scene, const Cone& cone, uint32_t seedFace, const ConeHit& hit);

/// Per cone: which lengths its outlier rule keeps, in normalised units. #S.
[[nodiscard]] std::vector<LengthWindow> keptLengths(const TraceScene& scene, const Cone& cone,
                                                    const TracedCones& traced);

/// The points that the rays of a few seeds met, as arrays, so that compilers compute them kLaneCount at a time: a
/// cone's rays are padded to whole runs of that. All arrays have cones x raysPerCone() entries. In normalised units.
class GatheredHits {
 public:
  GatheredHits(const TraceScene& scene, const Cone& cone, const TracedCones& traced,
               std::span<const LengthWindow> windows);

  /// Replaces what was gathered by the hits of these cones, indices into the seeds.
  void gather(std::span<const uint32_t> cones);

  /// A point of the surface as a hit that no outlier rule leaves out. Unit normal; area: of the surface that the point
  /// stands for. In normalised units.
  struct Point {
    Vec3d position, normal;
    double area = 0;
    uint32_t face = 0;
  };
  /// Adds points as further cones, as many as they fill. Returns how many that are.
  size_t append(std::span<const Point> points);

  [[nodiscard]] size_t raysPerCone() const { return raysPerCone_; }  ///< A multiple of kLaneCount.
  [[nodiscard]] size_t size() const { return x.size(); }

  std::vector<float> x, y, z;     ///< Where; NaN for a ray that met nothing, and for padding.
  std::vector<float> nx, ny, nz;  ///< The unit normal there.
  std::vector<float> spread;      ///< length^2 / (cosine of incidence + kGrazingSlack): the area a ray stands for.
  std::vector<float> kept;        ///< 1 where the seed's own outlier rule keeps the ray, else 0.
  std::vector<uint32_t> face;     ///< The face hit.

 private:
  void resize(size_t size);
  void put(size_t at, const ConeHit& hit, uint32_t seedFace, const ConeFrame& frame, const Vec3d& local,
           const LengthWindow& window);

  const TraceScene& scene_;
  const Cone& cone_;
  TracedCones traced_;
  std::span<const LengthWindow> windows_;
  size_t raysPerCone_;
  double raySolidAngle_;  ///< What each ray of a cone stands for.
};

/// Keeps the area of a ray that grazes a face finite.
inline constexpr float kGrazingSlack = 0.05f;

}  // namespace asdfvk
