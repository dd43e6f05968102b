#pragma once

#include <span>
#include <vector>

#include "asdf_vk/report.h"
#include "core/unset_vector.h"
#include "estimate/held_out.h"
#include "mesh/mesh.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

/// Input of the error estimate. Arrays without a stated size are #F.
struct EstimateInput {
  const TracedSeeds& traced;  ///< All seeds, held-out faces included.
  const HeldOutFaces& heldOut;
  /// #H: values at the held-out faces, interpolated without the traced values of these faces.
  std::span<const double> withoutHeldOut;
  /// Error indicator; empty: the same for all faces. The indicator distributes the errors measured at held-out faces
  /// over all faces: a ratio estimate with sampling weights (Cochran 1977, chapter 6).
  std::span<const double> indicator;
  std::span<const double> result;  ///< Interpolated from all seeds.
  bool predicts = true;            ///< Whether the interpolation used predictions.
};

struct EstimatedErrors {
  ErrorEstimate estimate;
  UnsetVector<double> expected;  ///< #F, in the unit of the mesh; 0 where a face has no value.
};

/// Error of the result, from the errors at held-out faces. estimate.heldOutCount is 0 in two cases: fewer than two
/// held-out faces have a value and a positive weight; the range of values is not positive.
[[nodiscard]] EstimatedErrors estimateErrors(const TriangleMesh& mesh, const EstimateInput& input);

}  // namespace asdfvk
