#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/region.h"

namespace asdfvk {

/// Number of input faces of the region without a value. field: #I.
[[nodiscard]] uint64_t countWithoutValue(const InputFaceSet& region, std::span<const double> field);

/// Adds the range of the values, the number of missing values of the region, and warnings about values and solver to
/// the report. sdf: #I. keepsMissing: see Computation.
void describeValues(Report& report, const PreparedMesh& prepared, const InputFaceSet& region,
                    const std::vector<double>& sdf, bool keepsMissing);

}  // namespace asdfvk
