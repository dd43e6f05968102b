#include "pipeline/seed_rounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace asdfvk {
namespace {

// The error falls about with the square root of the number of seeds; a round that aims a little beyond saves the next.
constexpr double kAim = 1.15;
constexpr double kLeastGrowth = 1.25, kGreatestGrowth = 4;
// A round that adds less than this share of the seeds is not worth its interpolation.
constexpr double kWorthwhile = 0.05;
// Of the time that is left: what a round may plan to use.
constexpr double kPlannedShare = 0.8;

std::vector<uint32_t> merged(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  std::vector<uint32_t> all;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

}  // namespace

SeedRounds::SeedRounds(const Mesh& mesh, const PreparedMesh& prepared, const Options& options, SeedTracing& tracing,
                       Interpolation& interpolation, const Stopwatch& clock, StageSeconds& seconds)
    : mesh_(mesh),
      prepared_(prepared),
      options_(options),
      tracing_(tracing),
      interpolation_(interpolation),
      clock_(clock),
      seconds_(seconds),
      estimates_(options.estimatesError || options.rounds.maxError.has_value()),
      placed_(prepared.geometry.areas.size()),
      probes_(placed_),
      traced_(placed_) {}

void SeedRounds::run(const RunControl& control) {
  uint64_t count = resolveSeedCount(options_.seeds, prepared_.castableFaces.size());
  const bool startsWithHalf = options_.isAdaptive && count < prepared_.castableFaces.size();
  if (startsWithHalf) {
    addSeeds(count - count / 2, {}, control.part(0, 0.4));
    interpolate(control.part(0.4, 0.45));
    estimate(control.part(0.45, 0.5));
    count /= 2;
  }
  const std::vector<double> weight = startsWithHalf && errors_ ? errors_->expected : std::vector<double>{};
  addSeeds(count, weight, control.part(startsWithHalf ? 0.5 : 0.0, 0.8));
  interpolate(control.part(0.8, 0.9));
  estimate(control.part(0.9, 1));
  while (const uint64_t further = furtherCount()) {
    const RunControl quiet{control.stop, {}};
    addSeeds(further, {}, quiet);
    interpolate(quiet);
    estimate(quiet);
  }
  control.checkpoint(1);
}

void SeedRounds::addSeeds(uint64_t count, std::span<const double> weight, const RunControl& control) {
  ++roundCount_;
  const Stopwatch sampleWatch;
  count = std::min(count, leftCount());
  const bool leavesSome = count < leftCount();
  const uint64_t probeCount = estimates_ && leavesSome ? probeCountFor(count, chosen_.probes.size()) : 0;
  const SeedChoice choice = chooseSeeds(prepared_, options_, count, probeCount, chosen_, weight);
  seconds_.sample += sampleWatch.seconds();

  const Stopwatch traceWatch;
  const double placedShare =
      static_cast<double>(choice.placed.size()) / static_cast<double>(std::max<uint64_t>(1, count));
  tracing_.trace(choice.placed, placed_, control.part(0, placedShare));
  tracing_.trace(choice.probes, probes_, control.part(placedShare, 1));
  tracing_.traceComponentsWithoutValue(placed_, probes_.isSeed, options_.randomSeed, control);
  chosen_ = {merged(chosen_.placed, choice.placed), merged(chosen_.probes, choice.probes)};
  traced_ = placed_;
  traced_.append(probes_);
  seconds_.trace += traceWatch.seconds();
}

void SeedRounds::interpolate(const RunControl& control) {
  const Stopwatch watch;
  result_ = interpolation_.run(traced_, seconds_, control);
  roundSeconds_ = watch.seconds();
}

void SeedRounds::estimate(const RunControl& control) {
  errors_.reset();
  if (probes_.faces.empty()) return;
  const Stopwatch watch;
  StageSeconds ignored;
  const Interpolated heldOut = interpolation_.run(placed_, ignored, control.part(0, 0.7));
  std::vector<double> other;
  if (!heldOut.prediction.empty()) other = interpolation_.runHarmonic(placed_, heldOut.values, control.part(0.7, 1));
  EstimatedErrors errors = estimateErrors(mesh_, {placed_, probes_, heldOut.values, other, result_.values});
  if (errors.estimate.heldOutCount > 0) errors_ = std::move(errors);
  seconds_.estimate += watch.seconds();
  roundSeconds_ += watch.seconds();
}

uint64_t SeedRounds::leftCount() const {
  return prepared_.castableFaces.size() - chosen_.placed.size() - chosen_.probes.size();
}

uint64_t SeedRounds::furtherCount() const {
  if (!options_.rounds.areAsked() || leftCount() == 0) return 0;
  return std::min({countForError(), countForTime(), leftCount()});
}

uint64_t SeedRounds::countForError() const {
  if (!options_.rounds.maxError) return leftCount();
  const auto seedCount = static_cast<double>(traced_.faces.size());
  if (!errors_) return static_cast<uint64_t>(std::ceil((kGreatestGrowth - 1) * seedCount));
  const double bound = errors_->estimate.average + errors_->estimate.standardError;
  if (bound <= *options_.rounds.maxError) return 0;
  const double growth = kAim * std::pow(bound / *options_.rounds.maxError, 2);
  return static_cast<uint64_t>(std::ceil((std::clamp(growth, kLeastGrowth, kGreatestGrowth) - 1) * seedCount));
}

uint64_t SeedRounds::countForTime() const {
  if (!options_.rounds.timeBudgetSeconds) return std::numeric_limits<uint64_t>::max();
  const auto seedCount = static_cast<double>(traced_.faces.size());
  const double left = *options_.rounds.timeBudgetSeconds - clock_.seconds() - roundSeconds_;
  const double perSeed = (seconds_.trace + seconds_.sample) / std::max(1.0, seedCount);
  const double count = kPlannedShare * left / std::max(perSeed, 1e-12);
  return count < kWorthwhile * seedCount ? 0 : static_cast<uint64_t>(count);
}

}  // namespace asdfvk
