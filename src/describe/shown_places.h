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

}  // namespace asdfvk
