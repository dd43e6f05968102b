#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/computation.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

class SeedTracing;

/// Thickness of all triangles.
struct FaceThickness {
  std::vector<double> values;     ///< #F, in the unit of the mesh; NaN for no value.
  std::vector<uint8_t> isTraced;  ///< #F, 1 where the value is from the rays of the face itself.
  uint64_t verifiedCount = 0;     ///< Faces traced by verifyThinRegions().
  TraceStatistics rays;           ///< Of these faces.
  ThicknessStatistics statistics;
};

/// Whether interpolated thickness must be verified: a limit is given, and not every face is a seed.
[[nodiscard]] bool verifiesThickness(const Computation& computation);

/// The thickness of the seeds, and for other faces its harmonic interpolation. Seeds without a valid hit and degenerate
/// faces keep "no value".
[[nodiscard]] FaceThickness interpolateThickness(const Computation& computation, const TracedSeeds& traced,
                                                 const RunControl& control);

/// Traces the faces whose thickness, minus its expected error, is below the limit, with their neighbours; then the
/// neighbours of thin faces until each thin face and all around it are traced. expectedErrors: #F, of the shape
/// diameter, or empty. An interpolated face that is not next to a thin face keeps its value.
void verifyThinRegions(const Computation& computation, SeedTracing& tracing, std::span<const double> expectedErrors,
                       FaceThickness& thickness, const RunControl& control);

/// The field: for each input face the least value of its triangles; NaN without one. values: #F. Returns #I.
[[nodiscard]] std::vector<double> thicknessOfInputFaces(const TriangleMesh& mesh, std::span<const double> values);

/// Percentiles, and the regions below the limit if there is one, of the faces of the domain. field:
/// thicknessOfInputFaces().
[[nodiscard]] ThicknessReport describeThickness(const PreparedMesh& prepared, const FaceDomain& domain,
                                                const FaceThickness& thickness, std::span<const double> field,
                                                const std::optional<double>& limit);

}  // namespace asdfvk
