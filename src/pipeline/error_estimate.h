#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "pipeline/report.h"
#include "pipeline/seed_tracing.h"

namespace asdfvk {

/// What the errors are estimated from. All values are #F.
struct HeldOutErrors {
  const TracedSeeds& traced;         ///< All seeds.
  std::span<const uint32_t> probes;  ///< Those of them that were chosen at random among the faces that are no others.
  std::span<const double> values;    ///< Interpolated without the probes.
  /// Another method's values from the same seeds, or empty: where the two are far apart errors are expected to be
  /// great. It spreads the errors seen at the probes over the faces (a ratio estimate, Cochran 1977, chapter 6), which
  /// takes a quarter off its standard error.
  std::span<const double> otherValues;
  std::span<const double> result;  ///< Interpolated from all seeds.
};

struct EstimatedErrors {
  ErrorEstimate estimate;
  std::vector<double> expected;  ///< #F, in the mesh's unit; 0 where a face has no value.
};

/// Needs two probes with a value and a positive range of values at least, else the estimate's heldOutCount is 0.
[[nodiscard]] EstimatedErrors estimateErrors(const Mesh& mesh, const HeldOutErrors& errors);

}  // namespace asdfvk
