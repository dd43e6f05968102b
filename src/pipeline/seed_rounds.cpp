#include "pipeline/seed_rounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "estimate/error_indicator.h"

namespace asdfvk {
namespace {

// The error of a face falls with about this power of the number of seeds (docs/experiments.md).
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

/// Hides the values of some faces as long as it lives.
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

}  // namespace

SeedRounds::SeedRounds(const TriangleMesh& mesh, const PreparedMesh& prepared, const Options& options,
                       SeedTracing& tracing, Interpolation& interpolation, const Stopwatch& clock,
                       StageSeconds& seconds, std::function<void()> afterLastRay)
    : mesh_(mesh),
      prepared_(prepared),
      options_(options),
      tracing_(tracing),
      interpolation_(interpolation),
      clock_(clock),
      seconds_(seconds),
      afterLastRay_(std::move(afterLastRay)),
      estimates_(options.estimatesError || options.rounds.maxError.has_value()),
      traced_(prepared.geometry.areas.size()) {}

void SeedRounds::run(const RunControl& control) {
  runRound(resolveSeedCount(options_.seeds, prepared_.castableFaces.size()), !options_.rounds.areAsked(), control);
  while (const uint64_t further = furtherCount()) runRound(further, false, {control.stop, {}});
  control.checkpoint(1);
}

void SeedRounds::runRound(uint64_t count, bool isLast, const RunControl& control) {
  const Stopwatch watch;
  const double earlierRays = seconds_.trace + seconds_.sample;
  errors_.reset();
  count = std::min(count, leftCount());
  const bool predicts = options_.interpolation.guidance == Guidance::Hits;
  const SeedShares shares =
      estimates_ && count < leftCount() ? shareOut(count, probes_.faces.size(), predicts) : SeedShares{.placed = count};
  tracing_.reserve(traced_, count);
  if (requireSampler(options_.sampler).refine && predicts && roundCount_ == 0 && count < leftCount()) {
    traceChosen({.placed = shares.placed - shares.placed / 2}, {}, control.part(0, 0.35));
    const std::vector<double> pattern = predictWithoutProbes(seconds_.sample);
    traceChosen({.placed = shares.placed / 2}, pattern, control.part(0.35, 0.7));
  } else {
    traceChosen({.placed = shares.placed, .probes = predicts ? 0 : shares.probes}, {}, control.part(0, 0.7));
  }
  const bool isToJudge = leftCount() > 0 && shares.probes + probes_.faces.size() > 0;
  HeldOut heldOut;
  std::vector<uint32_t> scouts;
  if (isToJudge && predicts) {
    heldOut.pattern = predictWithoutProbes(seconds_.estimate);
    control.checkpoint(0.73);
    scouts = traceByPrediction(shares, heldOut.pattern, control.part(0.73, 0.83));
  }
  if (isLast) afterLastRay_();
  if (isToJudge) heldOut.values = holdOut(scouts, control.part(0.83, 0.87));
  interpolation_.predict({traced_.faces, traced_.hits}, seconds_);
  control.checkpoint(0.93);
  result_ = interpolation_.run(traced_.values, seconds_, control.part(0.93, 1));
  if (isToJudge) estimate(heldOut);
  interpolationSeconds_ = watch.seconds() - (seconds_.trace + seconds_.sample - earlierRays);
}

void SeedRounds::traceChosen(const SeedShares& shares, std::span<const double> weight, const RunControl& control) {
  ++roundCount_;
  const Stopwatch sampleWatch;
  SeedChoice choice = chooseSeeds(prepared_, options_, shares, chosen_, weight);
  seconds_.sample += sampleWatch.seconds();
  const Stopwatch traceWatch;
  const auto placedCount = static_cast<double>(choice.placed.size()),
             probeCount = static_cast<double>(choice.probes.size());
  const double placedShare = placedCount / std::max(1.0, placedCount + probeCount);
  tracing_.trace(choice.placed, traced_, control.part(0, placedShare));
  tracing_.trace(choice.probes, traced_, control.part(placedShare, 1));
  std::vector<double> alike(choice.probes.size(), 1.0);
  probes_.append({std::move(choice.probes), std::move(alike)});
  {  // What is interpolated without the probes must have a value in each component, too.
    const HiddenValues hidden(traced_.values, probes_.faces);
    tracing_.traceComponentsWithoutValue(traced_, options_.randomSeed, control);
  }
  sortChosen();
  seconds_.trace += traceWatch.seconds();
}

void SeedRounds::sortChosen() {
  chosen_.probes = sorted(probes_.faces);
  const std::vector<uint32_t> all = sorted(traced_.faces);
  chosen_.placed.clear();
  std::set_difference(all.begin(), all.end(), chosen_.probes.begin(), chosen_.probes.end(),
                      std::back_inserter(chosen_.placed));
}

std::vector<double> SeedRounds::predictWithoutProbes(double& seconds) {
  const Stopwatch watch;
  StageSeconds ignored;
  std::vector<uint32_t> faces = traced_.faces;
  for (uint32_t& face : faces)
    if (std::binary_search(chosen_.probes.begin(), chosen_.probes.end(), face)) face = kNoFace;
  interpolation_.predict({faces, traced_.hits}, ignored);
  std::vector<double> pattern = errorPattern(interpolation_.prediction(), faces, traced_.values);
  seconds += watch.seconds();
  return pattern;
}

std::vector<uint32_t> SeedRounds::traceByPrediction(const SeedShares& shares, std::span<const double> pattern,
                                                    const RunControl& control) {
  const Stopwatch sampleWatch;
  std::vector<uint32_t> scouts =
      chooseScouts(prepared_, interpolation_.prediction().values, traced_.isSeed, shares.scouts);
  std::vector<uint32_t> candidates;
  auto scout = scouts.begin();
  for (const uint32_t face : prepared_.castableFaces)
    if (scout != scouts.end() && face == *scout)
      ++scout;
    else if (!traced_.isSeed[face])
      candidates.push_back(face);
  const Probes probes =
      chooseProbes(candidates, pattern, shares.probes, probeSeed(options_.randomSeed, probes_.faces.size()));
  seconds_.sample += sampleWatch.seconds();
  const Stopwatch traceWatch;
  std::vector<uint32_t> faces = scouts;
  faces.insert(faces.end(), probes.faces.begin(), probes.faces.end());
  tracing_.trace(sorted(std::move(faces)), traced_, control);
  probes_.append(probes);
  sortChosen();
  seconds_.trace += traceWatch.seconds();
  return scouts;
}

std::vector<double> SeedRounds::holdOut(std::span<const uint32_t> scouts, const RunControl& control) {
  const Stopwatch watch;
  StageSeconds ignored;
  std::vector<uint32_t> unknown = probes_.faces;
  unknown.insert(unknown.end(), scouts.begin(), scouts.end());
  const HiddenValues hidden(traced_.values, std::move(unknown));
  std::vector<double> values = interpolation_.run(traced_.values, ignored, control).values;
  seconds_.estimate += watch.seconds();
  return values;
}

void SeedRounds::estimate(const HeldOut& heldOut) {
  const Stopwatch watch;
  EstimatedErrors errors = estimateErrors(mesh_, {traced_, probes_, heldOut.values, heldOut.pattern, result_.values});
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
