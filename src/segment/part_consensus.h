#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/part_merging.h"
#include "segment/part_surface.h"
#include "segment/patches.h"

namespace asdfvk {

/// A division of the surface into patches.
struct Division {
  Patches patches;
  PatchData data;
  std::optional<PartMerging> merging;  ///< PartConsensus continues it to the last merge.
};

/// Merging of the patches of one division by the costs of several divisions: an average consensus of hierarchies
/// (Lapointe and Cucumel: The Average Consensus Procedure, 1997). Each division, at thresholds from threshold / e to
/// threshold * e, either separates two patches or not. The stability of the boundary between two regions is the share
/// of divisions and thresholds that separate them, as a mean over the pairs of their patches weighted by area. Adjacent
/// regions of least stability are merged first. Copies are independent. Deterministic.
class PartConsensus {
 public:
  /// The regions are at first the patches of the last division. threshold: cost at which merging stops.
  PartConsensus(const PartSurface& surface, std::span<const Division> divisions, double threshold);

  [[nodiscard]] uint32_t regionCount() const { return regionCount_; }
  /// 0 to 1; 1 also between components.
  [[nodiscard]] double stability(uint32_t patchOfOne, uint32_t patchOfOther) const;

  /// Merges while a boundary has at most this stability.
  void mergeUpTo(double stability);
  /// Merges until there are at most `count` regions, or until no two regions are adjacent.
  void mergeToCount(uint32_t count);
  /// Merges regions that have neighbours and an area below `area`, the smallest first.
  void mergeSmallerThan(double area);

  /// The region of each patch of the last division, numbered from 0 by the first patch.
  [[nodiscard]] std::vector<uint32_t> regionOfPatches() const;

 private:
  struct Border {
    uint32_t a, b;
  };

  [[nodiscard]] double stabilityOf(const Border& border) const;
  /// The border of least stability of the region; of all regions for kNoRegion. Null if there is none.
  [[nodiscard]] const Border* weakestBorder(uint32_t region) const;
  void merge(Border border);

  static constexpr uint32_t kNoRegion = 0xffffffff;

  std::vector<double> areas_;       ///< One per region; 0 for a region that was merged into another.
  std::vector<float> separated_;    ///< Regions x regions: sum of the stability of pairs of patches times their areas.
  std::vector<Border> borders_;     ///< Between adjacent regions, each once.
  std::vector<uint32_t> regionOf_;  ///< One region per patch.
  uint32_t regionCount_;
};

}  // namespace asdfvk
