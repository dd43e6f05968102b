#pragma once

#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "estimate/held_out.h"
#include "mesh/mesh.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// Input of the error estimate. Values are #F unless stated.
struct EstimateInput {
  const TracedSeeds& traced;  ///< All seeds, held-out faces included.
  const HeldOutFaces& heldOut;
  std::span<const double> withoutHeldOut;  ///< #H: values of the held-out faces, interpolated without them.
  /// Error indicator, or empty for a constant one. It distributes the errors measured at held-out faces over all faces:
  /// a ratio estimate (Cochran 1977, chapter 6). If it was also the sampling density, this is the estimate of Hansen
  /// and Hurwitz 1943.
  std::span<const double> indicator;
  std::span<const double> result;  ///< Interpolated from all seeds.
  bool predicts = true;            ///< Whether the interpolation used predictions.
};

struct EstimatedErrors {
  ErrorEstimate estimate;
  std::vector<double> expected;  ///< #F, in the unit of the mesh; 0 where a face has no value.
};

/// Error of the result, from the errors at held-out faces. estimate.heldOutCount is 0 if fewer than two held-out faces
/// have a value and a positive weight, or if the range of values is not positive.
[[nodiscard]] EstimatedErrors estimateErrors(const TriangleMesh& mesh, const EstimateInput& input);

}  // namespace asdfvk
