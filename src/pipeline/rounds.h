#pragma once

#include <cstdint>
#include <optional>

#include "estimate/error_estimate.h"
#include "pipeline/interpolation.h"
#include "pipeline/seed_tracing.h"
#include "trace/seeds.h"

namespace asdfvk {

/// Results on the nodes of a domain.
struct RoundsResult {
  Seeds seeds;
  Interpolated interpolated;
  UnsetVector<double> indicator;  ///< #N, see errorIndicator(); empty without a prediction or an estimate.
  std::optional<EstimatedErrors> errors;
  uint32_t roundCount = 0;
  std::optional<TraceVariant> traceVariant;
};

/// Chooses seeds, casts their rays, interpolates and estimates the error, in one round or several; each round keeps the
/// traced values of the earlier ones. The hierarchy and the tracer are made while other threads choose the first seeds.
/// The tracer is released after the last ray: before the last interpolation if no further round can follow. Throws
/// Error{Device} and Error{Cancelled}.
[[nodiscard]] RoundsResult runRounds(const Computation& computation, const RaySource& source,
                                     const RunControl& control);

}  // namespace asdfvk
