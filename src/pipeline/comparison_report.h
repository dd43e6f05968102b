#pragma once

#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "pipeline/comparison_points.h"

namespace asdfvk {

/// For each input face, its thickness minus its former thickness. A polygon has the least difference of its triangles.
[[nodiscard]] std::vector<double> thicknessChange(const MeasuredVersion& now, std::span<const double> formerThickness);

/// The report without its sentence. change: the result of thicknessChange(). described, former: reports on `now` and
/// `before`, after compareVersions().
[[nodiscard]] ComparisonReport describeComparison(const MeasuredVersion& now, std::span<const double> formerThickness,
                                                  std::span<const double> change, const ThicknessReport& described,
                                                  const MeasuredVersion& before, const ThicknessReport& former);

}  // namespace asdfvk
