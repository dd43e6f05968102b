#include "paper/evaluation.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/terminal.h"
#include "core/check.h"
#include "share_errors.h"
#include "spread.h"

namespace asdfvk::bench {
namespace {

/// What one run gives, kept until all rounds are done.
using Samples = std::vector<ShareResult>;

double medianOf(const Samples& samples, double ShareResult::*field) {
  std::vector<double> values;
  for (const ShareResult& sample : samples)
    if (!std::isnan(sample.*field)) values.push_back(sample.*field);
  return values.empty() ? kNoValue : spreadOf(values).median;
}

ShareResult medians(const Samples& samples) {
  ShareResult result = samples.front();
  for (double ShareResult::*field :
       {&ShareResult::average, &ShareResult::maximum, &ShareResult::truthAverage, &ShareResult::truthMaximum,
        &ShareResult::estimated, &ShareResult::sampleSeconds, &ShareResult::traceSeconds, &ShareResult::predictSeconds,
        &ShareResult::solveSeconds, &ShareResult::timeRatio})
    result.*field = medianOf(samples, field);
  return result;
}

/// What results are compared with.
struct Standards {
  const Result& full;
  const Result& truth;
};

double rangeOf(const Result& result) { return result.report.sdf.max - result.report.sdf.min; }

ShareResult judge(const Result& result, const Standards& standards, double percent, double fullTraceSeconds) {
  const ShareErrors errors = errorsOverRange(standards.full.sdf, result.sdf);
  const ShareErrors truthErrors = errorsOverRange(standards.truth.sdf, result.sdf);
  const double scale = rangeOf(standards.truth) / rangeOf(standards.full);
  const StageSeconds& seconds = result.report.stageSeconds;
  return {.percent = percent,
          .seedCount = result.report.seedCount,
          .average = errors.average,
          .maximum = errors.maximum,
          .truthAverage = truthErrors.average * scale,
          .truthMaximum = truthErrors.maximum * scale,
          .estimated = result.report.estimatedError ? result.report.estimatedError->average : kNoValue,
          .sampleSeconds = seconds.sample,
          .traceSeconds = seconds.trace,
          .predictSeconds = seconds.predict,
          .solveSeconds = seconds.solve,
          .timeRatio = (seconds.sample + seconds.trace + seconds.predict + seconds.solve) / fullTraceSeconds};
}

Result computeTruth(Session& session, Mesh& mesh, uint32_t rayCount, const RunControl& control) {
  Options options = recipeOptions(Recipe::Paper, 100, 1);
  options.cone.rayCount = rayCount;
  options.cone.rotation = ConeRotation::Hashed;
  return session.compute(mesh, options, control);
}

void tell(const std::string& name, const std::string& what) { writeStandardError(fmt::format("{}: {}\n", name, what)); }

}  // namespace

const ShareResult& Evaluation::at(Recipe recipe, double percent) const {
  const auto found = std::find(kPercents.begin(), kPercents.end(), percent);
  ASDFVK_CHECK(found != kPercents.end());
  return recipes[static_cast<size_t>(recipe)][static_cast<size_t>(found - kPercents.begin())];
}

Options recipeOptions(Recipe recipe, double percent, uint64_t randomSeed) {
  Options options;
  applyRecipe(recipe, options);
  options.seeds = {SeedCount::Kind::Share, percent / 100, 0};
  if (percent == 100) options.seeds.kind = SeedCount::Kind::All;
  options.randomSeed = randomSeed;
  return options;
}

Evaluation evaluate(Session& session, const std::string& name, Mesh& mesh, const EvaluationOptions& options,
                    const RunControl& control) {
  for (size_t i = 0; i < kRecipeCount; ++i) ASDFVK_CHECK_OP(static_cast<size_t>(kRecipes[i].second), ==, i);
  tell(name, "warming up");
  Evaluation evaluation;
  evaluation.name = name;
  for (const auto& [recipeName, recipe] : kRecipes)  // Compiles the kernels.
    static_cast<void>(session.compute(mesh, recipeOptions(recipe, 1, 1), control));
  evaluation.full = session.compute(mesh, recipeOptions(Recipe::Paper, 100, 1), control);
  if (!(evaluation.range() > 0))
    throw Error(ErrorCode::UnreadableInput,
                name + ": no two of its values differ, so that errors have no range to be divided by");
  tell(name, fmt::format("{} rays at each of {} faces", options.truthRayCount, evaluation.full.report.faceCount));
  const Result truth = computeTruth(session, mesh, options.truthRayCount, control);

  std::array<std::array<Samples, kPercents.size()>, kRecipeCount> samples;
  std::vector<double> fullTraceSeconds;
  for (uint32_t round = 1; round <= options.seedSetCount; ++round) {
    tell(name, fmt::format("seed set {} of {}", round, options.seedSetCount));
    static_assert(kPercents.front() == 100);
    for (size_t i = 0; i < kPercents.size(); ++i)
      for (size_t j = 0; j < kRecipeCount; ++j) {
        const Result part = session.compute(mesh, recipeOptions(kRecipes[j].second, kPercents[i], round), control);
        if (i == 0 && j == 0) fullTraceSeconds.push_back(part.report.stageSeconds.trace);
        samples[j][i].push_back(judge(part, {evaluation.full, truth}, kPercents[i], fullTraceSeconds.back()));
      }
  }
  evaluation.fullTraceSeconds = spreadOf(fullTraceSeconds).median;
  for (size_t j = 0; j < kRecipeCount; ++j)
    for (size_t i = 0; i < kPercents.size(); ++i) evaluation.recipes[j][i] = medians(samples[j][i]);
  return evaluation;
}

}  // namespace asdfvk::bench
