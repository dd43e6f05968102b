#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "pipeline/face_domain.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

/// Number of input faces of the domain without a value. field: #I.
[[nodiscard]] uint64_t countWithoutValue(const FaceDomain& domain, std::span<const double> field);

/// Adds the range of the values, the number of missing values of the domain, and warnings about values and solver to
/// the report. sdf: #I. keepsMissing: see Computation.
void describeValues(Report& report, const PreparedMesh& prepared, const FaceDomain& domain,
                    const std::vector<double>& sdf, bool keepsMissing);

}  // namespace asdfvk
