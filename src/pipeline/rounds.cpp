#include "pipeline/rounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "core/background_task.h"
#include "core/free_memory.h"
#include "core/parallel.h"
#include "estimate/error_indicator.h"
#include "estimate/held_out.h"
#include "pipeline/next_round.h"
#include "pipeline/seed_choice.h"
#include "pipeline/seed_prediction.h"

namespace asdfvk {
namespace {

// Parts of the progress of a round.
constexpr double kTracedProgress = 0.7, kIndicatorProgress = 0.75, kHeldOutTracedProgress = 0.85,
                 kPredictedProgress = 0.87;

/// What all rounds of a computation use.
struct RoundTools {
  RoundTools(const Computation& of, const RaySource& rays)
      : computation(of),
        prediction(of, rays.scene),
        solver(of.options, of.backend, of.warnings),
        arcAngles(of.domain.graph, of.domain.geometry),
        interpolation(of.domain, of.prepared.mesh, arcAngles, of.options, solver) {}

  const Computation& computation;
  std::unique_ptr<SeedTracing> tracing;  ///< Null before the first seeds are chosen and after the last ray.
  SeedPrediction prediction;
  EquationSolver solver;
  ArcAngles arcAngles;
  Interpolation interpolation;
};

uint64_t remainingCount(const Computation& computation, const Seeds& seeds) {
  return computation.domain.traceable.size() - seeds.size();
}

/// density: see chooseSeeds().
SeedChoice choose(RoundTools& tools, const Seeds& seeds, const SeedShares& shares, std::span<const double> density,
                  const RunControl& control) {
  const Computation& computation = tools.computation;
  const auto scope = computation.clock.time(Stage::Sample);
  return chooseSeeds(computation.domain, tools.arcAngles, computation.options, shares, seeds, density,
                     control.withoutProgress());
}

/// The first seeds are chosen in the background while this thread builds the hierarchy and makes the tracer. Therefore
/// chooseSeeds() must not read the hierarchy. Stage::Sample includes only the time for which this thread then waits.
SeedChoice chooseWhileOpening(RoundTools& tools, const RaySource& source, const SeedShares& shares,
                              const RunControl& control) {
  const Computation& computation = tools.computation;
  SeedChoice choice;
  BackgroundTask choosing([&] {
    choice = chooseSeeds(computation.domain, tools.arcAngles, computation.options, shares, {}, {},
                         control.withoutProgress());
  });
  callIsolated([&] { tools.tracing = std::make_unique<SeedTracing>(computation, source, control.withoutProgress()); });
  const auto scope = computation.clock.time(Stage::Sample);
  choosing.wait();
  return choice;
}

void traceChoice(RoundTools& tools, const SeedChoice& choice, Seeds& seeds, const RunControl& control) {
  const auto scope = tools.computation.clock.time(Stage::Trace);
  const auto sampledCount = static_cast<double>(choice.sampled.size()),
             heldOutCount = static_cast<double>(choice.heldOut.size());
  const double sampledShare = sampledCount / std::max(1.0, sampledCount + heldOutCount);
  tools.tracing->trace(choice.sampled, SeedKind::Sampled, seeds, control.part(0, sampledShare));
  tools.tracing->trace(choice.heldOut, SeedKind::HeldOut, seeds, control.part(sampledShare, 1));
  seeds.heldOutWeights.resize(seeds.heldOutWeights.size() + choice.heldOut.size(), 1.0);
  tools.tracing->traceComponentsWithoutValue(seeds, control);
}

/// Predicts from all seeds except held-out seeds. Returns the error indicator of this prediction, #N.
UnsetVector<double> indicateErrors(RoundTools& tools, Seeds& seeds, Stage stageOfPrediction, Stage stageOfIndicator,
                                   const RunControl& control) {
  StageClock& clock = tools.computation.clock;
  const std::vector<uint32_t> nodes = nodesWithoutHeldOut(seeds);
  {
    const auto scope = clock.time(stageOfPrediction);
    tools.prediction.predict(nodes, seeds, control);
  }
  const auto scope = clock.time(stageOfIndicator);
  return errorIndicator(tools.prediction.last(), nodes, seeds.values);
}

/// Traces extreme seeds, the nodes with the greatest predictions, and held-out seeds that are sampled by the indicator.
void traceByPrediction(RoundTools& tools, const SeedShares& shares, std::span<const double> indicator, Seeds& seeds,
                       const RunControl& control) {
  const Computation& computation = tools.computation;
  const FaceDomain& domain = computation.domain;
  std::vector<uint32_t> nodes;
  std::vector<SeedKind> kinds;
  {
    const auto scope = computation.clock.time(Stage::Sample);
    std::vector<uint8_t> isSeed = seedFlags(seeds, domain.size());
    const std::vector<uint32_t> extremes =
        extremeSeeds(domain.traceable, tools.prediction.last().values, isSeed, shares.extreme);
    for (const uint32_t node : extremes) isSeed[node] = 1;
    const HeldOutFaces heldOut = sampleHeldOut(
        selectInParallel(domain.traceable, [&](uint32_t node) { return isSeed[node] == 0; }), indicator, shares.heldOut,
        heldOutSeed(computation.options.randomSeed, seeds.heldOutWeights.size()), domain.representedCounts);
    std::ranges::merge(extremes, heldOut.faces, std::back_inserter(nodes));
    for (const uint32_t node : nodes) kinds.push_back(isSeed[node] != 0 ? SeedKind::Extreme : SeedKind::HeldOut);
    seeds.heldOutWeights.insert(seeds.heldOutWeights.end(), heldOut.weights.begin(), heldOut.weights.end());
  }
  const auto scope = computation.clock.time(Stage::Trace);
  tools.tracing->trace(nodes, kinds, seeds, control);
}

/// #H: the values at the held-out seeds, interpolated without them and without the extreme seeds of this round, which
/// begins with the seed `firstOfRound`. NaN for a seed without a traced value. solved: interpolated from all seeds.
std::vector<double> solveWithoutHeldOut(RoundTools& tools, const Seeds& seeds, size_t firstOfRound,
                                        std::span<const double> solved) {
  std::vector<size_t> measured;  // Places of held-out seeds with a value; the others have no error.
  std::vector<uint32_t> nodes;
  for (size_t seed = 0, place = 0; seed < seeds.size(); ++seed) {
    if (!seeds.isHeldOut(seed)) continue;
    if (!std::isnan(seeds.values[seed])) {
      measured.push_back(place);
      nodes.push_back(seeds.nodes[seed]);
    }
    ++place;
  }
  const std::vector<double> constraints = constraintsOf(seeds, tools.computation.domain.size(), [&](size_t seed) {
    return !seeds.isHeldOut(seed) && (seed < firstOfRound || seeds.kinds[seed] != SeedKind::Extreme);
  });
  const std::vector<double> values =
      tools.interpolation.valuesAt(nodes, constraints, tools.prediction.last().values, solved);
  std::vector<double> ofHeldOut(seeds.heldOutWeights.size(), kNoValue);
  for (size_t i = 0; i < measured.size(); ++i) ofHeldOut[measured[i]] = values[i];
  return ofHeldOut;
}

/// Computes the values and, if `estimates`, their errors.
void interpolate(RoundTools& tools, size_t firstOfRound, bool estimates, RoundsResult& result,
                 const RunControl& control) {
  const Computation& computation = tools.computation;
  StageClock& clock = computation.clock;
  Seeds& seeds = result.seeds;
  const bool isPredicted = estimates && computation.predicts();  // The prediction was made without held-out seeds.
  Prediction withAll;
  {
    const auto scope = clock.time(isPredicted ? Stage::Estimate : Stage::Predict);
    const RunControl predicting = control.part(0, kPredictedProgress);
    if (isPredicted)
      withAll = tools.prediction.withFurtherSeeds(seeds, predicting);
    else
      tools.prediction.predict(seeds.nodes, seeds, predicting);
  }
  const std::span<const double> predicted = isPredicted ? withAll.values : tools.prediction.last().values;
  if (!tools.tracing) seeds.freeHits();  // No further round follows.
  control.checkpoint(kPredictedProgress);
  {
    const auto scope = clock.time(Stage::Solve);
    result.interpolated =
        tools.interpolation.solve(constraintsOf(seeds, computation.domain.size(), [](size_t) { return true; }),
                                  predicted, control.part(kPredictedProgress, 1));
  }
  std::vector<double> withoutHeldOut;
  if (estimates) {
    const auto scope = clock.time(Stage::Estimate);
    withoutHeldOut = solveWithoutHeldOut(tools, seeds, firstOfRound, result.interpolated.values);
  }
  tools.interpolation.pool(predicted, result.interpolated.values);
  if (!estimates) return;
  const auto scope = clock.time(Stage::Estimate);
  EstimatedErrors errors =
      estimateErrors(computation.scene.mesh, computation.domain,
                     {seeds, withoutHeldOut, result.indicator, result.interpolated.values, computation.predicts()});
  if (errors.estimate.heldOutCount > 0) result.errors = std::move(errors);
}

/// count: number of seeds of the round.
void runRound(RoundTools& tools, const RaySource& source, uint64_t count, RoundsResult& result,
              const RunControl& control) {
  const Computation& computation = tools.computation;
  const Options& options = computation.options;
  Seeds& seeds = result.seeds;
  const size_t firstOfRound = seeds.size();
  const bool isFirst = !tools.tracing, predicts = computation.predicts(),
             leavesNodes = count < remainingCount(computation, seeds);
  const SeedShares shares = options.estimatesError && leavesNodes
                                ? shareSeeds(count, seeds.heldOutWeights.size(), predicts)
                                : SeedShares{.sampled = count};
  const bool refines = samplerOf(options.sampler).refine && predicts && isFirst && leavesNodes;
  const uint64_t refiningCount = refines ? shares.sampled / 2 : 0;
  const SeedShares first{.sampled = shares.sampled - refiningCount, .heldOut = predicts ? 0 : shares.heldOut};
  result.errors.reset();
  freeMemory(result.indicator);
  const SeedChoice choice =
      isFirst ? chooseWhileOpening(tools, source, first, control) : choose(tools, seeds, first, {}, control);
  if (isFirst) {
    result.traceVariant = tools.tracing->traceVariant();
    seeds.hitsOnDevice = tools.tracing->makeDeviceHits();
  }
  tools.tracing->reserveHits(seeds, count, control);
  traceChoice(tools, choice, seeds, control.part(0, refines ? kTracedProgress / 2 : kTracedProgress));
  if (refines) {
    const UnsetVector<double> density =
        indicateErrors(tools, seeds, Stage::Sample, Stage::Sample, control.withoutProgress());
    traceChoice(tools, choose(tools, seeds, {.sampled = refiningCount}, density, control), seeds,
                control.part(kTracedProgress / 2, kTracedProgress));
  }
  result.roundCount += refines ? 2 : 1;
  const bool estimates = remainingCount(computation, seeds) > 0 && shares.heldOut + seeds.heldOutWeights.size() > 0;
  if (estimates && predicts) {
    result.indicator = indicateErrors(tools, seeds, Stage::Predict, Stage::Estimate,
                                      control.part(kTracedProgress, kIndicatorProgress));
    control.checkpoint(kIndicatorProgress);
    traceByPrediction(tools, shares, result.indicator, seeds, control.part(kIndicatorProgress, kHeldOutTracedProgress));
  }
  if (!options.rounds.areSet()) tools.tracing.reset();
  interpolate(tools, firstOfRound, estimates, result, control.part(kHeldOutTracedProgress, 1));
}

}  // namespace

RoundsResult runRounds(const Computation& computation, const RaySource& source, const RunControl& control) {
  RoundTools tools(computation, source);
  RoundsResult result;
  result.seeds.hitsPerSeed = computation.keepsHits() ? computation.cone.directions.size() : 0;
  const uint64_t traceableCount = computation.domain.traceable.size();
  runRound(tools, source, resolveSeedCount(computation.options, traceableCount), result, control);
  while (const uint64_t further =
             furtherSeedCount(computation.options.rounds, result.errors ? &result.errors->estimate : nullptr,
                              result.seeds.size(), traceableCount))
    runRound(tools, source, further, result, control.withoutProgress());
  control.checkpoint(1);
  return result;
}

}  // namespace asdfvk
