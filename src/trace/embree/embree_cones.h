#pragma once

#include <array>
#include <span>
#include <vector>

#include "trace/embree/embree_rays.h"
#include "trace/embree/lane_cones.h"
#include "trace/embree/near_faces.h"

namespace asdfvk {

/// What does not change from cone to cone. Views only.
struct EmbreeCones {
  const TraceScene& scene;
  const Cone& cone;
  std::span<const SlotPlane> planes;
  const EmbreeScene& embree;
  double rayStart = 0;  ///< In normalised units.
};

/// A cone to trace and where its hits go.
struct EmbreeSeed {
  uint32_t face = 0, slot = 0;
  std::span<ConeHit> hits;  ///< A ray's each, or none.
};

/// Traces up to eight cones side by side, the same ray of each at once, with room that is kept from call to call.
class EmbreeConeGroup {
 public:
  static constexpr size_t kWidth = EmbreeRays::kWidth;

  explicit EmbreeConeGroup(const EmbreeCones& cones);

  /// Adds a cone to those that trace() will trace. Precondition: there are fewer than kWidth, and the face is not
  /// degenerate.
  void add(const EmbreeSeed& seed);
  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] const EmbreeSeed& seed(size_t lane) const { return seeds_[lane]; }

  /// Computes the values of all cones that were added.
  void trace();
  void clear();

  /// In normalised units, or kNoValue. Meaningless when isDoubtful().
  [[nodiscard]] double value(size_t lane) const { return values_[lane]; }
  /// Whether float32 may have got the cone wrong, so that the reference is to trace it: the face or the value is too
  /// small, another face is as near as rays begin, a ray came back to the face, or leavesSurface().
  [[nodiscard]] bool isDoubtful(size_t lane) const { return isDoubtful_[lane]; }
  /// Whether a ray met nothing or the outer side of a face, as it does where it fell between two triangles of a closed
  /// surface; never in robust mode, nor of a cone that was doubtful before its rays. Unseen stays a ray that is inside
  /// a second shell as well, or that fell between two triangles twice.
  [[nodiscard]] bool leavesSurface(size_t lane) const;

 private:
  EmbreeCones cones_;
  EmbreeRays rays_;
  LaneFrames frames_;
  LaneCones lanes_;
  size_t size_ = 0;
  std::array<EmbreeSeed, kWidth> seeds_;
  std::array<SlotPoint, kWidth> points_;
  std::array<double, kWidth> values_{};
  std::array<bool, kWidth> isUnfit_{};  // Casts no rays.
  std::array<bool, kWidth> isDoubtful_{};
  std::vector<LaneHits> met_;  // Per ray.

  void findUnfit();
  [[nodiscard]] bool metItself(size_t lane) const;
  void writeHits(size_t lane) const;
};

}  // namespace asdfvk
