#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "pipeline/probe_choice.h"
#include "pipeline/report.h"
#include "pipeline/seed_tracing.h"

namespace asdfvk {

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
[[nodiscard]] EstimatedErrors estimateErrors(const Mesh& mesh, const HeldOutErrors& errors);

}  // namespace asdfvk
