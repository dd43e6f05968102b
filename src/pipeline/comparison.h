#pragma once

#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "pipeline/comparison_points.h"

namespace asdfvk {

/// Compares the walls of two versions (wall_changes.h). Returns for each face (#F) the thickness of the former version
/// at the place of the barycentre (counterpartsOf()); NaN if there is none. Throws Error{Cancelled}.
[[nodiscard]] std::vector<double> compareVersions(const MeasuredVersion& now, const MeasuredVersion& former,
                                                  const RunControl& control);

/// For each input face, its thickness minus its former thickness. A polygon has the least difference of its triangles.
[[nodiscard]] std::vector<double> thicknessChange(const MeasuredVersion& now, std::span<const double> formerThickness);

/// The report without its sentence. change: the result of thicknessChange(). described, former: reports on `now` and
/// `before`, after compareVersions().
[[nodiscard]] ComparisonReport describeComparison(const MeasuredVersion& now, std::span<const double> formerThickness,
                                                  std::span<const double> change, const ThicknessReport& described,
                                                  const MeasuredVersion& before, const ThicknessReport& former);

}  // namespace asdfvk
