#pragma once

#include <vector>

#include "asdf_vk/run_control.h"
#include "pipeline/comparison_points.h"

namespace asdfvk {

/// Compares the walls of two versions (wall_changes.h). Returns for each face (#F) the thickness of the former version
/// at the place of the barycentre (counterpartsOf()); NaN if there is none. Throws Error{Cancelled}.
[[nodiscard]] std::vector<double> compareVersions(const MeasuredVersion& now, const MeasuredVersion& former,
                                                  const RunControl& control);

}  // namespace asdfvk
