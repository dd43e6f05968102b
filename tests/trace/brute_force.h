#pragma once

#include <cstdint>
#include <vector>

#include "cone/cone.h"
#include "mesh/mesh.h"
#include "shared/cone_hit.h"

namespace asdfvk {

/// Judges the reference tracer and shares no code with it but the cone's table and frame: all faces against each ray,
/// in the mesh's own coordinates, intersections by signed volumes, the value by sorting.
struct BruteForceCone {
  std::vector<double> rayLengths;  ///< One per ray of the cone; NaN for a dropped one.
  /// The nearest hit of each ray, dropped or not, in the mesh's unit; infinity and kNoFace for a miss.
  std::vector<double> hitDistances;
  std::vector<uint32_t> hitFaces;
  double value = kNoValue;
};

/// Precondition: the seed face is not degenerate.
[[nodiscard]] BruteForceCone traceByBruteForce(const Mesh& mesh, const Cone& cone, uint32_t seedFace);

/// The value of a cone from its rays' lengths, NaN for a dropped one, by the definition of CGAL or of the paper.
[[nodiscard]] double cgalValueBySorting(const std::vector<double>& rayLengths);
[[nodiscard]] double valueBySorting(const std::vector<double>& rayLengths, const std::vector<double>& weights);

}  // namespace asdfvk
