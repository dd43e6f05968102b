#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "predict/prediction_kernel.h"
#include "predict/traced_cones.h"

namespace asdfvk {

/// The points that the rays of some seeds met, in normalised units: what faces that cast no rays look at.
class SeedPoints {
 public:
  /// What it refers to must outlive it.
  SeedPoints(const TraceScene& scene, const Cone& cone, const TracedCones& traced);

  void clear();

  /// Adds the points of a seed's rays as one cone and returns where that is.
  PointCone gather(uint32_t seed);

  [[nodiscard]] const std::vector<PointGroup>& groups() const { return groups_; }

 private:
  [[nodiscard]] PointCone appendCone(size_t pointCount);

  const TraceScene& scene_;
  const Cone& cone_;
  TracedCones traced_;
  std::vector<PointGroup> groups_;
};

}  // namespace asdfvk
