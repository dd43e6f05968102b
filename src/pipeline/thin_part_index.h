#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "pipeline/comparison_points.h"
#include "trace/nearest_point.h"
#include "trace/thin_regions.h"

namespace asdfvk {

/// The thin parts of a version, of all kinds: the kind of a place near the limits of a kind depends on the
/// triangulation.
class ThinPartIndex {
 public:
  explicit ThinPartIndex(const MeasuredVersion& version) : version_(version) {
    const std::vector<ConnectedThinParts>& regions = version.thickness.regions;
    for (uint32_t region = 0; region < regions.size(); ++region)
      for (const ThinPart& part : regions[region].parts) parts_.push_back(rowOf(part, region));
    std::stable_sort(parts_.begin(), parts_.end(), [](const Row& a, const Row& b) { return a.face < b.face; });
  }

  /// Calls take(region) for the regions that have the point. Returns whether there is one.
  template <typename Take>
  bool forEachAt(const Counterpart& at, const Take& take) const {
    bool isThin = false;
    auto row = std::lower_bound(parts_.begin(), parts_.end(), at.face,
                                [](const Row& each, uint32_t face) { return each.face < face; });
    for (; row != parts_.end() && row->face == at.face; ++row) {
      const Vec3d between = at.point - row->middle;
      if (dot(between, between) > row->squaredReach) continue;  // Large faces have many parts.
      const PlaneTriangle triangle{row->part->corners, version_.computation.prepared.geometry.normals[at.face]};
      if (length(nearestPoint(triangle, at.point) - at.point) > kOnPart) continue;
      isThin = true;
      take(row->region);
    }
    return isThin;
  }
  [[nodiscard]] bool contains(const Counterpart& at) const {
    return forEachAt(at, [](uint32_t) {});
  }

 private:
  /// A point is on a part if it is at most this far away (normalised).
  static constexpr double kOnPart = 4 * kUnresolved;

  struct Row {
    uint32_t face = 0, region = 0;
    const ThinPart* part = nullptr;
    Vec3d middle;
    double squaredReach = 0;  ///< Points of the part are at most this far from its middle.
  };

  static Row rowOf(const ThinPart& part, uint32_t region) {
    const Vec3d middle = middleOf(part.corners);
    double reach = 0;
    for (const Vec3d& corner : part.corners) reach = std::max(reach, length(corner - middle) + kOnPart);
    return {part.face, region, &part, middle, reach * reach};
  }

  const MeasuredVersion& version_;
  std::vector<Row> parts_;  // Ascending by face.
};

}  // namespace asdfvk
