#include "pipeline/next_round.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/elementary.h"

namespace asdfvk {
namespace {

// The error of a face falls with about this power of the number of seeds (docs/accuracy.md).
constexpr double kConvergence = 0.4;
constexpr double kMinGrowth = 1.25, kMaxGrowth = 4, kGrowthStep = 1.05;
// The error is bounded by the estimate plus this many standard errors.
constexpr double kStandardErrors = 1.5;

/// Number of further seeds until the bound of an error is at most `maximum`; 0 without a maximum. estimate,
/// standardError: of the error now.
double countForTarget(std::optional<double> maximum, double estimate, double standardError, double seedCount,
                      double candidateCount) {
  if (!maximum) return 0;
  const double target = *maximum, bound = estimate + kStandardErrors * standardError;
  if (bound <= target) return 0;
  // The number of interpolated faces falls with the number of seeds. The error of an interpolated face falls with a
  // power of the number of seeds.
  const double perFace = bound / (1 - seedCount / candidateCount);
  double growth = kMinGrowth;
  while (growth < kMaxGrowth && growth * seedCount < candidateCount &&
         (1 - growth * seedCount / candidateCount) * perFace * power(growth, -kConvergence) > target)
    growth *= kGrowthStep;
  return std::ceil((growth - 1) * seedCount);
}

}  // namespace

uint64_t furtherSeedCount(const RoundOptions& options, const ErrorEstimate* errors, uint64_t seedCount,
                          uint64_t traceableCount) {
  if (!options.areSet()) return 0;
  const auto seeds = static_cast<double>(seedCount), candidates = static_cast<double>(traceableCount);
  const double wanted =
      errors == nullptr
          ? std::ceil((kMaxGrowth - 1) * seeds)
          : std::max(countForTarget(options.maxError, errors->average, errors->standardError, seeds, candidates),
                     countForTarget(options.maxRelativeError, errors->relativeMedian,
                                    errors->relativeMedianStandardError, seeds, candidates));
  return std::min(static_cast<uint64_t>(wanted), traceableCount - seedCount);
}

}  // namespace asdfvk
