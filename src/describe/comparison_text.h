#pragma once

#include <string>

#include "asdf_vk/report.h"
#include "describe/thickness_text.h"

namespace asdfvk {

/// The verdict on new and thinner walls, such as "FAIL: 1 new wall (limit 0.8): 0.3 at (0, 1, 2), face 12; 3 walls
/// kept"; without a limit, where the mesh became thinner. Precondition: report.comparison and report.thickness are set.
/// hasPlaces: see verdictSentence().
[[nodiscard]] std::string comparisonSentence(const Report& report, bool hasPlaces = true);

/// All walls, without a verdict, and the thinner part of the surface. Empty without a limit. Precondition: as above.
[[nodiscard]] ReportRows comparisonRows(const Report& report);

/// Lists of the walls that are gone and of the regions that became thinner.
[[nodiscard]] ReportRows comparedPlaceRows(const ComparisonReport& comparison);

}  // namespace asdfvk
