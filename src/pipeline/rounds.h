#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "estimate/error_estimate.h"
#include "pipeline/interpolation.h"
#include "pipeline/seed_prediction.h"
#include "pipeline/seed_tracing.h"
#include "trace/traced_seeds.h"

namespace asdfvk {

struct RoundsResult {
  TracedSeeds traced;  ///< All seeds.
  Interpolated interpolated;
  std::optional<EstimatedErrors> errors;
  uint32_t roundCount = 0;
  std::optional<TraceVariant> traceVariant;
};

using MakeSeedTracing = std::function<std::unique_ptr<SeedTracing>()>;

/// Chooses seeds, casts their rays, interpolates and estimates the error, in one round or several; each round keeps the
/// traced values of the earlier ones. makeTracing() is called once, while other threads choose the first seeds. Its
/// result is released after the last ray: before the last interpolation if no further round can follow.
[[nodiscard]] RoundsResult runRounds(const Computation& computation, const MakeSeedTracing& makeTracing,
                                     const RunControl& control);

}  // namespace asdfvk
