#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "estimate/held_out.h"
#include "mesh/mesh.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// The error of the result against the function traced at all faces, cross-validated: some faces, chosen at random
/// among those that are no seeds, more of them where errors are expected, cast rays too and are held out of an
/// interpolation of their own; what it is off by there is scaled up to all faces. Their rays are not lost: in the
/// result they are seeds like the others, which makes it a little better than what was judged; the estimate allows for
/// that.
struct ErrorEstimate {
  double average = 0;  ///< Over all faces, seeds included, over the range of the values: as in the paper's Table 1.
  double standardError = 0;  ///< Of `average`: the spread among the held-out faces, and what they add as seeds.
  uint64_t heldOutCount = 0;
  /// The held-out faces with the greatest errors, greatest first.
  struct WorstFace {
    uint64_t face = 0;  ///< Input face.
    double error = 0;   ///< Over the range.
  };
  std::vector<WorstFace> worstFaces;
};

/// What the errors are estimated from. All values are #F.
struct HeldOutErrors {
  const TracedSeeds& traced;       ///< All seeds.
  const Probes& probes;            ///< Those of them that were chosen at random among the faces that are no others.
  std::span<const double> values;  ///< Interpolated without the probes.
  /// How great the errors are expected to be, above 0 and up to a factor, or empty: alike everywhere. It spreads the
  /// errors seen at the probes over the faces (a ratio estimate, Cochran 1977, chapter 6; where the probes were chosen
  /// by it, too, that of Hansen and Hurwitz 1943).
  std::span<const double> pattern;
  std::span<const double> result;  ///< Interpolated from all seeds.
};

struct EstimatedErrors {
  ErrorEstimate estimate;
  std::vector<double> expected;  ///< #F, in the mesh's unit; 0 where a face has no value.
};

/// What the probes are off by, scaled up to all faces and down by what they add once they are seeds themselves. Needs
/// two probes with a value and a weight, and a positive range of values at least, else the estimate's heldOutCount is
/// 0.
[[nodiscard]] EstimatedErrors estimateErrors(const TriangleMesh& mesh, const HeldOutErrors& errors);

}  // namespace asdfvk
