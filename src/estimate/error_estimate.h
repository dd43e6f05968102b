#pragma once

#include <span>

#include "asdf_vk/report.h"
#include "core/unset_vector.h"
#include "mesh/face_domain.h"
#include "mesh/mesh.h"
#include "trace/seeds.h"

namespace asdfvk {

/// Input of the error estimate.
struct EstimateInput {
  const Seeds& seeds;
  /// #H, in the order of the held-out seeds: the values there, interpolated without their traced values.
  std::span<const double> withoutHeldOut;
  /// #N: error indicator; empty: the same for all nodes. The indicator distributes the errors measured at held-out
  /// seeds over all faces: a ratio estimate with sampling weights (Cochran 1977, chapter 6).
  std::span<const double> indicator;
  std::span<const double> result;  ///< #N, interpolated from all seeds.
  bool predicts = true;            ///< Whether the interpolation used predictions.
};

struct EstimatedErrors {
  ErrorEstimate estimate;   ///< robustAverage is set by expectedErrors().
  double average = 0;       ///< Average error in the unit of the mesh.
  double perIndicator = 0;  ///< Expected error of an interpolated face, divided by its indicator.
};

/// Error of the result, from the errors at held-out seeds. A face that a node represents has the expected error of an
/// interpolated node. estimate.heldOutCount is 0 in two cases: fewer than two held-out seeds have a value and a
/// positive weight; the range of values is not positive.
[[nodiscard]] EstimatedErrors estimateErrors(const TriangleMesh& mesh, const FaceDomain& domain,
                                             const EstimateInput& input);

/// #F: the expected error of each face in the unit of the mesh; 0 for a face without a value. Sets
/// estimate.robustAverage. seeds: its nodes are faces. values, indicator: #F; the indicator may be empty.
[[nodiscard]] UnsetVector<double> expectedErrors(EstimatedErrors& errors, const Seeds& seeds,
                                                 std::span<const double> values, std::span<const double> indicator);

}  // namespace asdfvk
