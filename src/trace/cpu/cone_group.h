#pragma once

#include <array>
#include <span>
#include <vector>

#include "trace/cpu/lane_cones.h"
#include "trace/cpu/ray_walk.h"

namespace asdfvk {

struct CpuCones {
  const TraceScene& scene;
  const Cone& cone;
  const LaneBvh& bvh;
};

struct CpuSeed {
  ConeStart start;
  uint32_t primitive = kNoFace;  ///< The primitive that contains the origin; kNoFace: no primitive.
  bool fitsFloat = true;         ///< False: no ray is cast, and isDoubtful() is true.
  std::span<ConeHit> hits;       ///< One per ray, or empty. All cones of a group have hits, or none.
};

/// Traces up to kWidth neighbouring cones together: the first ray of all cones, then the second, and so on. Lengths are
/// in normalised units. An object reuses its memory.
class ConeGroup {
 public:
  static constexpr size_t kWidth = LaneHits::kWidth;

  explicit ConeGroup(const CpuCones& cones);

  /// Precondition: fewer than kWidth cones were added since clear().
  void add(const CpuSeed& seed);
  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] const CpuSeed& seed(size_t lane) const { return seeds_[lane]; }

  void trace();
  void clear();

  /// The value of a cone in normalised units, or kNoValue. The value is meaningless if isDoubtful() is true.
  [[nodiscard]] double value(size_t lane) const { return values_[lane]; }
  /// Whether the reference must trace the cone because float32 may be too coarse: CpuSeed::fitsFloat is false, or the
  /// value is below kMinFloatDiameter.
  [[nodiscard]] bool isDoubtful(size_t lane) const {
    return !seeds_[lane].fitsFloat || values_[lane] < kMinFloatDiameter;
  }

 private:
  void cast(const Vec3d& coneDirection);
  void setFaces(const RayGroup::Indices& primitives, LaneHits& hits) const;
  void writeHits(size_t lane) const;

  CpuCones cones_;
  RayWalk walk_;
  RayGroup rays_;
  LaneFrames frames_;
  LaneCones lanes_;
  size_t size_ = 0;
  std::array<CpuSeed, kWidth> seeds_;
  std::array<double, kWidth> values_{};
  std::vector<LaneHits> hits_;  // One entry per ray.
};

}  // namespace asdfvk
