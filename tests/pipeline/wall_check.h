#pragma once

#include <algorithm>
#include <optional>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "mesh/mesh.h"
#include "support/shared_session.h"

namespace asdfvk::test {

inline Options limitedTo(std::optional<double> limit, Orientation orientation = Orientation::Keep) {
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = limit;
  options.orientation = orientation;
  return options;
}

inline ThicknessReport check(const Mesh& mesh, std::optional<double> limit,
                             Orientation orientation = Orientation::Keep) {
  return referenceSession().compute(mesh, limitedTo(limit, orientation)).report.thickness.value();
}

inline bool reportHas(const Report& report, WarningCode code) {
  return std::any_of(report.warnings.begin(), report.warnings.end(), [&](const Warning& w) { return w.code == code; });
}

}  // namespace asdfvk::test
