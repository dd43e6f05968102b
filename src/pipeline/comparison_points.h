#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/mesh.h"
#include "pipeline/computation.h"
#include "pipeline/judged_surface.h"
#include "pipeline/surface_points.h"
#include "pipeline/thickness.h"

namespace asdfvk {

/// One of two versions of a mesh, with its thickness.
struct MeasuredVersion {
  const Computation& computation;  ///< Its mesh and scene are those of the surface.
  const JudgedSurface& surface;
  FaceThickness& thickness;
};

/// Points of a surface, in the unit of the mesh.
struct PlacedPoints {
  std::vector<Vec3d> points, normals;
  std::vector<uint32_t> faces;
  std::vector<ThicknessRange> thickness;  ///< Empty until measured.

  void add(const MeasuredVersion& version, uint32_t face, const Vec3d& point);
  [[nodiscard]] size_t size() const { return points.size(); }
};

/// The thickness at the barycentre of a face.
[[nodiscard]] ThicknessRange rangeAtBarycentre(const MeasuredVersion& version, uint32_t face);
/// Sets the thickness of the points.
void measure(const MeasuredVersion& version, PlacedPoints& placed, const RunControl& control);

/// The point of a version that is at the same place as a point of the other version.
struct Counterpart {
  uint32_t face = kNoFace;  ///< A face of the surface; kNoFace if there is none.
  Vec3d point;              ///< Normalised.
  ThicknessRange thickness{kNoValue, kNoValue};
};

/// For each point, the nearest point of the other version whose normal differs by less than 90 degrees, if it is at
/// most half of the greater of the two thicknesses away. placed: measured. Throws Error{Cancelled}.
[[nodiscard]] std::vector<Counterpart> counterpartsOf(const PlacedPoints& placed, const MeasuredVersion& other,
                                                      const RunControl& control);

/// Whether a thickness is certainly below kThinnerShare of the former one.
[[nodiscard]] inline bool isThinner(const ThicknessRange& now, const ThicknessRange& former) {
  return now.high < kThinnerShare * former.low;
}

}  // namespace asdfvk
