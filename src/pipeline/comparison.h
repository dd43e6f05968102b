#pragma once

#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "pipeline/computation.h"
#include "pipeline/judged_surface.h"
#include "pipeline/thickness.h"

namespace asdfvk {

/// One of two versions of a mesh, with its thickness.
struct MeasuredVersion {
  const Computation& computation;  ///< Its mesh and scene are those of the surface.
  const JudgedSurface& surface;
  FaceThickness& thickness;
};

/// Two points of the versions are at the same place if one is the nearest point of its surface whose normal differs by
/// less than 90 degrees from that of the other, and at most half of the greater thickness away. A wall is a wall of the
/// other version if a point of it is at the same place as a point of that wall. It became thinner if its least
/// thickness, or that at an eighth of its points, is below kThinnerShare of that of the former version. Sets
/// FaceThickness::wallChanges of both versions. Returns for each face (#F) the thickness of the former version at the
/// barycentre; NaN if there is none. Throws Error{Cancelled}.
[[nodiscard]] std::vector<double> compareVersions(const MeasuredVersion& now, const MeasuredVersion& former,
                                                  const RunControl& control);

/// For each input face, its thickness minus its former thickness. A polygon has the least difference of its triangles.
[[nodiscard]] std::vector<double> thicknessChange(const MeasuredVersion& now, std::span<const double> formerThickness);

/// The report without its sentence. change: the result of thicknessChange(). described, former: reports on both
/// versions, after compareVersions().
[[nodiscard]] ComparisonReport describeComparison(const MeasuredVersion& now, std::span<const double> formerThickness,
                                                  std::span<const double> change, const ThicknessReport& described,
                                                  const ThicknessReport& former);

}  // namespace asdfvk
