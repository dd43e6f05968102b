#include "pipeline/rounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/background_task.h"
#include "core/free_memory.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "estimate/error_indicator.h"
#include "pipeline/aggregated_mesh.h"
#include "pipeline/seed_choice.h"

namespace asdfvk {
namespace {

// The error of a face falls with about this power of the number of seeds (docs/accuracy.md).
constexpr double kConvergence = 0.4;
constexpr double kMinGrowth = 1.25, kMaxGrowth = 4, kGrowthStep = 1.05;
// The error is bounded by the estimate plus this many standard errors.
constexpr double kStandardErrors = 1.5;
// A round that adds less than this share of the seeds is not run.
constexpr double kMinRoundShare = 0.05;
// Share of the remaining time that a round may plan to use.
constexpr double kPlannedShare = 0.8;
// Above the number of faces of any mesh.
constexpr double kMaxSeedCount = 1e18;

// Parts of the progress of a round.
constexpr double kTracedProgress = 0.7, kIndicatorProgress = 0.75, kHeldOutTracedProgress = 0.85,
                 kPredictedProgress = 0.87;

/// Sorts faces whose first part is usually sorted.
std::vector<uint32_t> sorted(std::vector<uint32_t> faces) {
  const auto end = std::is_sorted_until(faces.begin(), faces.end());
  sortInParallel(end, faces.end());
  std::inplace_merge(faces.begin(), end, faces.end());
  return faces;
}

/// Hides the values of some faces while the object exists.
class HiddenValues {
 public:
  HiddenValues(std::vector<double>& values, std::vector<uint32_t> faces) : values_(values), faces_(std::move(faces)) {
    for (const uint32_t face : faces_) hidden_.push_back(std::exchange(values_[face], kNoValue));
  }
  ~HiddenValues() {
    for (size_t i = 0; i < faces_.size(); ++i) values_[faces_[i]] = hidden_[i];
  }
  HiddenValues(const HiddenValues&) = delete;
  HiddenValues& operator=(const HiddenValues&) = delete;

 private:
  std::vector<double>& values_;
  std::vector<uint32_t> faces_;
  std::vector<double> hidden_;
};

class Rounds {
 public:
  Rounds(const Computation& computation, const MakeSeedTracing& makeTracing)
      : computation_(computation),
        options_(computation.options),
        clock_(computation.clock),
        makeTracing_(makeTracing),
        prediction_(computation),
        solver_(computation.options, computation.backend, computation.solvers, computation.warnings),
        arcAngles_(computation.domain.graph, computation.prepared.geometry),
        interpolation_(computation.domain, computation.prepared, arcAngles_, computation.options, solver_),
        traced_(computation.prepared.geometry.areas.size(),
                computation.keepsHits() ? computation.cone.directions.size() : 0) {}

  RoundsResult run(const RunControl& control) {
    const uint64_t traceableCount = computation_.domain.traceableFaces.size();
    runRound(resolveSeedCount(options_, traceableCount), !options_.rounds.areSet(), control);
    while (const uint64_t further = furtherCount()) runRound(further, false, control.withoutProgress());
    control.checkpoint(1);
    return {std::move(traced_), std::move(result_), std::move(errors_), roundCount_, std::move(traceVariant_)};
  }

 private:
  void runRound(uint64_t count, bool isLast, const RunControl& control);
  [[nodiscard]] SeedChoice choose(const SeedShares& shares, std::span<const double> density, const RunControl& control);
  [[nodiscard]] SeedChoice timedChoice(const SeedShares& shares, std::span<const double> density,
                                       const RunControl& control);
  [[nodiscard]] SeedChoice chooseWhileOpening(const SeedShares& shares, const RunControl& control);
  void traceChosen(SeedChoice choice, const RunControl& control);
  void sortSampled();
  std::vector<uint32_t> predictWithoutHeldOut(Stage stage, const RunControl& control);
  [[nodiscard]] UnsetVector<double> indicateErrors(Stage stage, std::span<const uint32_t> predictedFrom);
  std::vector<uint32_t> traceByPrediction(const SeedShares& shares, std::span<const double> indicator,
                                          const RunControl& control);
  void interpolate(std::span<const uint32_t> extremes, UnsetVector<double> indicator, bool estimates,
                   const RunControl& control);
  [[nodiscard]] std::vector<double> solveWithoutHeldOut(std::span<const uint32_t> extremes);
  [[nodiscard]] uint64_t furtherCount() const;
  [[nodiscard]] uint64_t countForError() const;
  [[nodiscard]] uint64_t countForTarget(std::optional<double> maximum, double estimate, double standardError) const;
  [[nodiscard]] uint64_t countForTime() const;
  [[nodiscard]] uint64_t remainingCount() const;
  [[nodiscard]] double raySeconds() const {
    return clock_.secondsOf(Stage::Trace) + clock_.secondsOf(Stage::Sample) + hiddenSampleSeconds_;
  }

  const Computation& computation_;
  const Options& options_;
  StageClock& clock_;
  const MakeSeedTracing& makeTracing_;
  std::unique_ptr<SeedTracing> tracing_;  ///< Null before the first seeds are chosen and after the last ray.
  std::optional<TraceVariant> traceVariant_;
  SeedPrediction prediction_;
  EquationSolver solver_;
  ArcAngles arcAngles_;
  Interpolation interpolation_;

  SeedChoice sampled_;  ///< All seeds. `sampled` includes extreme seeds.
  TracedSeeds traced_;
  HeldOutFaces heldOut_;
  Interpolated result_;
  std::optional<EstimatedErrors> errors_;
  double hiddenSampleSeconds_ = 0;   ///< Time of the choice of the first seeds that Stage::Sample does not include.
  double interpolationSeconds_ = 0;  ///< Time of the last round without its rays.
  uint32_t roundCount_ = 0;
};

void Rounds::runRound(uint64_t count, bool isLast, const RunControl& control) {
  errors_.reset();
  count = std::min(count, remainingCount());
  const bool predicts = computation_.predicts();
  const SeedShares shares = options_.estimatesError && count < remainingCount()
                                ? shareSeeds(count, heldOut_.faces.size(), predicts)
                                : SeedShares{.sampled = count};
  const bool refines = samplerOf(options_).refine && predicts && roundCount_ == 0 && count < remainingCount();
  const uint64_t refiningCount = refines ? shares.sampled / 2 : 0;
  const SeedShares first{.sampled = shares.sampled - refiningCount, .heldOut = predicts ? 0 : shares.heldOut};
  SeedChoice choice = roundCount_ == 0 ? chooseWhileOpening(first, control) : timedChoice(first, {}, control);
  const double begin = clock_.elapsed(), earlierRays = raySeconds();
  traced_.faces.reserve(traced_.faces.size() + count);
  traced_.hits.reserve(traced_.hits.size() + count * traced_.hitsPerSeed);
  traceChosen(std::move(choice), control.part(0, refines ? kTracedProgress / 2 : kTracedProgress));
  if (refines) {
    const UnsetVector<double> density =
        indicateErrors(Stage::Sample, predictWithoutHeldOut(Stage::Sample, control.withoutProgress()));
    traceChosen(timedChoice({.sampled = refiningCount}, density, control),
                control.part(kTracedProgress / 2, kTracedProgress));
  }
  const bool estimates = remainingCount() > 0 && shares.heldOut + heldOut_.faces.size() > 0;
  UnsetVector<double> indicator;
  std::vector<uint32_t> extremes;
  if (estimates && predicts) {
    indicator = indicateErrors(
        Stage::Estimate, predictWithoutHeldOut(Stage::Predict, control.part(kTracedProgress, kIndicatorProgress)));
    control.checkpoint(kIndicatorProgress);
    extremes = traceByPrediction(shares, indicator, control.part(kIndicatorProgress, kHeldOutTracedProgress));
  }
  if (isLast) tracing_.reset();
  interpolate(extremes, std::move(indicator), estimates, control.part(kHeldOutTracedProgress, 1));
  interpolationSeconds_ = clock_.elapsed() - begin - (raySeconds() - earlierRays);
}

/// Computes the result and, if `estimates`, its errors. extremes: the extreme seeds of this round.
void Rounds::interpolate(std::span<const uint32_t> extremes, UnsetVector<double> indicator, bool estimates,
                         const RunControl& control) {
  const bool hasPrediction = estimates && computation_.predicts();  // The prediction is made without held-out faces.
  std::vector<ReplacedValue> replaced;
  {
    const auto scope = clock_.time(hasPrediction ? Stage::Estimate : Stage::Predict);
    const RunControl predicting = control.part(0, kPredictedProgress);
    if (hasPrediction)
      replaced = prediction_.addSeeds({traced_.faces, traced_.hits}, predicting);
    else
      prediction_.predict({traced_.faces, traced_.hits}, predicting);
  }
  if (!tracing_) freeMemory(traced_.hits);  // No further round follows.
  control.checkpoint(kPredictedProgress);
  {
    const auto scope = clock_.time(Stage::Solve);
    result_ = interpolation_.solve(traced_.values, prediction_.last().values, control.part(kPredictedProgress, 1));
  }
  std::vector<double> withoutHeldOut;  // #H
  if (estimates) {
    const auto scope = clock_.time(Stage::Estimate);
    prediction_.exchange(replaced);
    withoutHeldOut = solveWithoutHeldOut(extremes);
    prediction_.exchange(replaced);
  }
  interpolation_.pool(prediction_.last().values, result_.values);
  if (const AggregatedMesh* const aggregated = computation_.domain.aggregated) {
    const auto scope = clock_.time(Stage::Solve);
    aggregated->spread(result_.values, indicator);
  }
  if (estimates) {
    const auto scope = clock_.time(Stage::Estimate);
    EstimatedErrors errors = estimateErrors(computation_.scene.mesh, {traced_, heldOut_, withoutHeldOut, indicator,
                                                                      result_.values, computation_.predicts()});
    if (errors.estimate.heldOutCount > 0) errors_ = std::move(errors);
  }
}

/// density: see chooseSeeds().
SeedChoice Rounds::choose(const SeedShares& shares, std::span<const double> density, const RunControl& control) {
  return chooseSeeds(computation_.domain, computation_.prepared.geometry, arcAngles_, options_, shares, sampled_,
                     density, control.withoutProgress());
}

SeedChoice Rounds::timedChoice(const SeedShares& shares, std::span<const double> density, const RunControl& control) {
  const auto scope = clock_.time(Stage::Sample);
  return choose(shares, density, control);
}

/// The first seeds are chosen in the background while this thread builds the hierarchy and makes the tracer. Therefore
/// choose() must not read the hierarchy. Stage::Sample includes only the time for which this thread then waits.
SeedChoice Rounds::chooseWhileOpening(const SeedShares& shares, const RunControl& control) {
  SeedChoice choice;
  double seconds = 0;
  BackgroundTask choosing([&] {
    const Stopwatch watch;
    choice = choose(shares, {}, control);
    seconds = watch.seconds();
  });
  callIsolated([&] {
    tracing_ = makeTracing_();
    traceVariant_ = tracing_->traceVariant();
  });
  const Stopwatch watch;
  const auto scope = clock_.time(Stage::Sample);
  choosing.wait();
  hiddenSampleSeconds_ = std::max(0.0, seconds - watch.seconds());
  return choice;
}

void Rounds::traceChosen(SeedChoice choice, const RunControl& control) {
  ++roundCount_;
  const auto scope = clock_.time(Stage::Trace);
  const auto sampledCount = static_cast<double>(choice.sampled.size()),
             heldOutCount = static_cast<double>(choice.heldOut.size());
  const double sampledShare = sampledCount / std::max(1.0, sampledCount + heldOutCount);
  tracing_->trace(choice.sampled, traced_, control.part(0, sampledShare));
  tracing_->trace(choice.heldOut, traced_, control.part(sampledShare, 1));
  std::vector<double> equalWeights(choice.heldOut.size(), 1.0);
  heldOut_.append({std::move(choice.heldOut), std::move(equalWeights)});
  {  // The interpolation without held-out faces needs a value in each component, too.
    const HiddenValues hidden(traced_.values, heldOut_.faces);
    tracing_->traceComponentsWithoutValue(traced_, control);
  }
  sortSampled();
}

void Rounds::sortSampled() {
  sampled_.heldOut = sorted(heldOut_.faces);
  const std::vector<uint32_t> all = sorted(traced_.faces);
  sampled_.sampled.clear();
  std::set_difference(all.begin(), all.end(), sampled_.heldOut.begin(), sampled_.heldOut.end(),
                      std::back_inserter(sampled_.sampled));
}

/// Predicts from all seeds except held-out faces. Returns these seeds: #S as in traced_.faces, kNoFace for held-out
/// faces.
std::vector<uint32_t> Rounds::predictWithoutHeldOut(Stage stage, const RunControl& control) {
  const auto scope = clock_.time(stage);
  std::vector<uint32_t> faces = traced_.faces;
  for (uint32_t& face : faces)
    if (std::binary_search(sampled_.heldOut.begin(), sampled_.heldOut.end(), face)) face = kNoFace;
  prediction_.predict({faces, traced_.hits}, control);
  return faces;
}

/// The error indicator, #F, from the last prediction. predictedFrom: the seeds of this prediction. stage: the stage to
/// charge.
UnsetVector<double> Rounds::indicateErrors(Stage stage, std::span<const uint32_t> predictedFrom) {
  const auto scope = clock_.time(stage);
  return errorIndicator(prediction_.last(), predictedFrom, traced_.values);
}

/// Traces extreme seeds, the faces with the greatest predictions, and held-out faces that are sampled by the indicator.
/// Returns the extreme seeds.
std::vector<uint32_t> Rounds::traceByPrediction(const SeedShares& shares, std::span<const double> indicator,
                                                const RunControl& control) {
  std::vector<uint32_t> extremes, faces;
  HeldOutFaces heldOut;
  {
    const auto scope = clock_.time(Stage::Sample);
    const std::span<const uint32_t> traceable = computation_.domain.traceableFaces;
    extremes = extremeSeeds(traceable, prediction_.last().values, traced_.isSeed, shares.extreme);
    const std::vector<uint32_t> candidates = selectInParallel(traceable, [&](uint32_t face) {
      return !traced_.isSeed[face] && !std::binary_search(extremes.begin(), extremes.end(), face);
    });
    const AggregatedMesh* const aggregated = computation_.domain.aggregated;
    const UnsetVector<uint32_t> counts = aggregated ? aggregated->representedCounts() : UnsetVector<uint32_t>();
    heldOut = sampleHeldOut(candidates, indicator, shares.heldOut,
                            heldOutSeed(options_.randomSeed, heldOut_.faces.size()), counts);
    faces = extremes;
    faces.insert(faces.end(), heldOut.faces.begin(), heldOut.faces.end());
  }
  const auto scope = clock_.time(Stage::Trace);
  tracing_->trace(sorted(std::move(faces)), traced_, control);
  heldOut_.append(heldOut);
  sortSampled();
  return extremes;
}

/// #H: the values of the held-out faces, interpolated without them and without these extreme seeds. NaN for a face
/// without a traced value.
std::vector<double> Rounds::solveWithoutHeldOut(std::span<const uint32_t> extremes) {
  std::vector<size_t> measured;  // Held-out faces without a traced value have no error.
  std::vector<uint32_t> faces;
  for (size_t i = 0; i < heldOut_.faces.size(); ++i) {
    if (std::isnan(traced_.values[heldOut_.faces[i]])) continue;
    measured.push_back(i);
    faces.push_back(heldOut_.faces[i]);
  }
  std::vector<uint32_t> unknown = heldOut_.faces;
  unknown.insert(unknown.end(), extremes.begin(), extremes.end());
  const HiddenValues hidden(traced_.values, std::move(unknown));
  const std::vector<double> values =
      interpolation_.valuesAt(faces, traced_.values, prediction_.last().values, result_.values);
  std::vector<double> ofHeldOut(heldOut_.faces.size(), kNoValue);
  for (size_t i = 0; i < measured.size(); ++i) ofHeldOut[measured[i]] = values[i];
  return ofHeldOut;
}

uint64_t Rounds::remainingCount() const {
  return computation_.domain.traceableFaces.size() - sampled_.sampled.size() - sampled_.heldOut.size();
}

/// Number of seeds of the next round; 0 if the conditions of the rounds are fulfilled.
uint64_t Rounds::furtherCount() const {
  if (!options_.rounds.areSet() || remainingCount() == 0) return 0;
  return std::min({countForError(), countForTime(), remainingCount()});
}

uint64_t Rounds::countForError() const {
  const RoundOptions& rounds = options_.rounds;
  if (!rounds.limitError()) return remainingCount();
  if (!errors_) return static_cast<uint64_t>(std::ceil((kMaxGrowth - 1) * static_cast<double>(traced_.faces.size())));
  const ErrorEstimate& estimate = errors_->estimate;
  return std::max(
      countForTarget(rounds.maxError, estimate.average, estimate.standardError),
      countForTarget(rounds.maxRelativeError, estimate.relativeMedian, estimate.relativeMedianStandardError));
}

/// Number of further seeds until the bound of an error is at most `maximum`; 0 without a maximum. estimate,
/// standardError: of the error now.
uint64_t Rounds::countForTarget(std::optional<double> maximum, double estimate, double standardError) const {
  if (!maximum) return 0;
  const auto seedCount = static_cast<double>(traced_.faces.size());
  const double target = *maximum, bound = estimate + kStandardErrors * standardError;
  if (bound <= target) return 0;
  // The number of interpolated faces falls with the number of seeds. The error of an interpolated face falls with a
  // power of the number of seeds.
  const auto candidateCount = static_cast<double>(computation_.domain.traceableFaces.size());
  const double perFace = bound / (1 - seedCount / candidateCount);
  double growth = kMinGrowth;
  while (growth < kMaxGrowth && growth * seedCount < candidateCount &&
         (1 - growth * seedCount / candidateCount) * perFace * std::pow(growth, -kConvergence) > target)
    growth *= kGrowthStep;
  return static_cast<uint64_t>(std::ceil((growth - 1) * seedCount));
}

uint64_t Rounds::countForTime() const {
  if (!options_.rounds.timeBudgetSeconds) return std::numeric_limits<uint64_t>::max();
  const auto seedCount = static_cast<double>(traced_.faces.size());
  const double remaining = *options_.rounds.timeBudgetSeconds - clock_.elapsed() - interpolationSeconds_;
  const double perSeed = raySeconds() / std::max(1.0, seedCount);
  const double count = kPlannedShare * remaining / std::max(perSeed, 1e-12);
  if (count < kMinRoundShare * seedCount) return 0;
  return static_cast<uint64_t>(std::min(count, kMaxSeedCount));
}

}  // namespace

RoundsResult runRounds(const Computation& computation, const MakeSeedTracing& makeTracing, const RunControl& control) {
  return Rounds(computation, makeTracing).run(control);
}

}  // namespace asdfvk
