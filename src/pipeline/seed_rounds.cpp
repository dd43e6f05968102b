#include "pipeline/seed_rounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace asdfvk {
namespace {

// The error of a face falls with about this power of the number of seeds (bench/NOTES.md).
constexpr double kConvergence = 0.4;
constexpr double kLeastGrowth = 1.25, kGreatestGrowth = 4, kStep = 1.05;
// So many standard errors above the estimate the error is taken to be.
constexpr double kCaution = 1.5;
// A round that adds less than this share of the seeds is not worth its interpolation.
constexpr double kWorthwhile = 0.05;
// Of the time that is left: what a round may plan to use.
constexpr double kPlannedShare = 0.8;
// More than any mesh has faces.
constexpr double kMostSeeds = 1e18;

std::vector<uint32_t> sorted(std::vector<uint32_t> faces) {
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// How densely the faces deserve seeds. At the seeds themselves, which err by nothing, as on average; empty where no
/// error is expected anywhere.
std::vector<double> densityFor(std::vector<double> expectedErrors) {
  double sum = 0;
  size_t count = 0;
  for (const double error : expectedErrors)
    if (error > 0) {
      sum += error;
      ++count;
    }
  if (count == 0) return {};
  for (double& error : expectedErrors)
    if (!(error > 0)) error = sum / static_cast<double>(count);
  return expectedErrors;
}

}  // namespace

SeedRounds::SeedRounds(const Mesh& mesh, const PreparedMesh& prepared, const Options& options, SeedTracing& tracing,
                       Interpolation& interpolation, const Stopwatch& clock, StageSeconds& seconds,
                       std::function<void()> afterLastRay)
    : mesh_(mesh),
      prepared_(prepared),
      options_(options),
      tracing_(tracing),
      interpolation_(interpolation),
      clock_(clock),
      seconds_(seconds),
      afterLastRay_(std::move(afterLastRay)),
      estimates_(options.estimatesError || options.rounds.maxError.has_value() || options.isAdaptive),
      placed_(prepared.geometry.areas.size()),
      probes_(placed_),
      traced_(0) {}

void SeedRounds::run(const RunControl& control) {
  const uint64_t count = resolveSeedCount(options_.seeds, prepared_.castableFaces.size());
  const bool isOneRun = !options_.rounds.areAsked();
  if (options_.isAdaptive && count < prepared_.castableFaces.size()) {
    runRound(count - count / 2, {}, false, control.part(0, 0.5));
    const std::vector<double> weight = errors_ ? densityFor(errors_->expected) : std::vector<double>{};
    runRound(count / 2, weight, isOneRun, control.part(0.5, 1));
  } else {
    runRound(count, {}, isOneRun, control);
  }
  while (const uint64_t further = furtherCount()) runRound(further, {}, false, {control.stop, {}});
  control.checkpoint(1);
}

void SeedRounds::runRound(uint64_t count, std::span<const double> weight, bool isLast, const RunControl& control) {
  ++roundCount_;
  const Stopwatch watch;
  const double earlierRays = seconds_.trace + seconds_.sample;
  errors_.reset();
  count = std::min(count, leftCount());
  const bool predicts = options_.interpolation.guidance == Guidance::Hits;
  const bool judges = estimates_ && count < leftCount();
  const SeedShares shares = judges ? shareOut(count, probes_.faces.size(), predicts) : SeedShares{.placed = count};
  traceChosen(shares, weight, control.part(0, 0.8));
  const bool isToJudge = !probes_.faces.empty() && leftCount() > 0;
  std::vector<double> heldOutPrediction;
  std::optional<TracedSeeds> scouts;
  if (isToJudge) {
    const Stopwatch estimateWatch;
    StageSeconds ignored;
    heldOutPrediction = interpolation_.predict(placed_, ignored);
    seconds_.estimate += estimateWatch.seconds();
    control.checkpoint(0.83);
    if (shares.scouts > 0) scouts = traceScouts(heldOutPrediction, shares.scouts, control);
  }
  if (isLast) afterLastRay_();
  HeldOut heldOut;
  if (isToJudge) heldOut = holdOut(std::move(heldOutPrediction), control.part(0.83, 0.87));
  if (scouts) placed_.append(*std::exchange(scouts, std::nullopt));
  joinPlacedAndProbes(isLast);
  std::vector<double> prediction = interpolation_.predict(traced_, seconds_);
  control.checkpoint(0.93);
  result_ = interpolation_.run(traced_, std::move(prediction), seconds_, control.part(0.93, 1));
  if (isToJudge) estimate(heldOut);
  interpolationSeconds_ = watch.seconds() - (seconds_.trace + seconds_.sample - earlierRays);
}

void SeedRounds::traceChosen(const SeedShares& shares, std::span<const double> weight, const RunControl& control) {
  const Stopwatch sampleWatch;
  const SeedChoice choice = chooseSeeds(prepared_, options_, shares, chosen_, weight);
  seconds_.sample += sampleWatch.seconds();
  const Stopwatch traceWatch;
  const auto placedCount = static_cast<double>(choice.placed.size()),
             probeCount = static_cast<double>(choice.probes.size());
  const double placedShare = placedCount / std::max(1.0, placedCount + probeCount);
  tracing_.trace(choice.placed, placed_, control.part(0, placedShare));
  tracing_.trace(choice.probes, probes_, control.part(placedShare, 1));
  tracing_.traceComponentsWithoutValue(placed_, probes_.isSeed, options_.randomSeed, control);
  chosen_ = {sorted(placed_.faces), sorted(probes_.faces)};  // With those that components without a value were given.
  seconds_.trace += traceWatch.seconds();
}

TracedSeeds SeedRounds::traceScouts(std::span<const double> prediction, uint64_t count, const RunControl& control) {
  const Stopwatch watch;
  std::vector<uint8_t> isSeed = placed_.isSeed;
  for (const uint32_t face : probes_.faces) isSeed[face] = 1;
  TracedSeeds scouts(isSeed.size());
  tracing_.trace(chooseScouts(prepared_, prediction, isSeed, count), scouts, {control.stop, {}});
  chosen_.placed.insert(chosen_.placed.end(), scouts.faces.begin(), scouts.faces.end());
  chosen_.placed = sorted(std::move(chosen_.placed));
  seconds_.trace += watch.seconds();
  return scouts;
}

SeedRounds::HeldOut SeedRounds::holdOut(std::vector<double> prediction, const RunControl& control) {
  const Stopwatch watch;
  StageSeconds ignored;
  const bool isGuided = !prediction.empty();
  HeldOut heldOut{interpolation_.run(placed_, std::move(prediction), ignored, control.part(0, 0.7)).values, {}};
  if (isGuided) heldOut.harmonic = interpolation_.runHarmonic(placed_, heldOut.guided, control.part(0.7, 1));
  seconds_.estimate += watch.seconds();
  return heldOut;
}

void SeedRounds::joinPlacedAndProbes(bool isLast) {
  std::vector<ConeHit> hits = isLast ? std::exchange(placed_.hits, {}) : placed_.hits;
  traced_.hits = {};  // Before it is copied into: there may be many.
  traced_.values = placed_.values;
  traced_.isSeed = placed_.isSeed;
  traced_.faces = placed_.faces;
  traced_.statistics = placed_.statistics;
  traced_.hits = std::move(hits);
  traced_.append(probes_);
}

void SeedRounds::estimate(const HeldOut& heldOut) {
  const Stopwatch watch;
  EstimatedErrors errors = estimateErrors(mesh_, {placed_, probes_, heldOut.guided, heldOut.harmonic, result_.values});
  if (errors.estimate.heldOutCount > 0) errors_ = std::move(errors);
  seconds_.estimate += watch.seconds();
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
  const double target = *options_.rounds.maxError;
  const double bound = errors_->estimate.average + kCaution * errors_->estimate.standardError;
  if (bound <= target) return 0;
  // The faces left fall with the seeds, and the error of each of them with a power of their number.
  const auto candidateCount = static_cast<double>(prepared_.castableFaces.size());
  const double perFace = bound / (1 - seedCount / candidateCount);
  double growth = kLeastGrowth;
  while (growth < kGreatestGrowth && growth * seedCount < candidateCount &&
         (1 - growth * seedCount / candidateCount) * perFace * std::pow(growth, -kConvergence) > target)
    growth *= kStep;
  return static_cast<uint64_t>(std::ceil((growth - 1) * seedCount));
}

uint64_t SeedRounds::countForTime() const {
  if (!options_.rounds.timeBudgetSeconds) return std::numeric_limits<uint64_t>::max();
  const auto seedCount = static_cast<double>(traced_.faces.size());
  const double left = *options_.rounds.timeBudgetSeconds - clock_.seconds() - interpolationSeconds_;
  const double perSeed = (seconds_.trace + seconds_.sample) / std::max(1.0, seedCount);
  const double count = kPlannedShare * left / std::max(perSeed, 1e-12);
  if (count < kWorthwhile * seedCount) return 0;
  return static_cast<uint64_t>(std::min(count, kMostSeeds));
}

}  // namespace asdfvk
