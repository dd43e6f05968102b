#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/report.h"

namespace asdfvk {

/// What pages and pictures show of the comparisons with limits: the thin places of the thickness, then those of gaps,
/// and sealed voids.
struct ShownPlaces {
  double limit = 0;  ///< The limit of the thickness; without one, the limit of the gaps.
  /// Failed if a comparison failed, else NotJudged if one was not judged.
  ThicknessVerdict verdict = ThicknessVerdict::Passed;
  std::string sentence;  ///< ThicknessReport::sentence; that of the gaps follows.
  std::string legend;    ///< The sentence without the verdict and without coordinates.
  std::string title;     ///< "thinner than 0.8", "closer than 0.3", or both.
  bool countsDetails = false, countsEdges = false;
  std::vector<ThinRegion> regions;  ///< The regions to which ThinSurface::regions refers.
  std::vector<SealedVoid> voids;    ///< Report::voids
};

/// Empty if nothing was compared with a limit.
[[nodiscard]] std::optional<ShownPlaces> shownPlaces(const Report& report);

/// The place of ThicknessReport::min.
struct LeastPlace {
  const char* kind = "";  ///< The kind as a word: "wall", "gap", "detail" or "edge".
  double value = 0;
  uint64_t face = 0;
  Vec3d place, opposite;
};

/// The least place of the comparison that failed, else that of the thickness, else that of gaps.
[[nodiscard]] std::optional<LeastPlace> leastPlace(const Report& report);

}  // namespace asdfvk
