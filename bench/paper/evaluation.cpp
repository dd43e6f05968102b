#include "paper/evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "asdf_vk/files.h"
#include "core/check.h"
#include "generate/shapes.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace asdfvk::bench {
namespace {

/// The stem of the path. Characters that are not allowed in NamedMesh::name are replaced by "_".
std::string plainStem(const std::string& path) {
  std::string stem = std::filesystem::path(path).stem().string();
  std::replace_if(
      stem.begin(), stem.end(),
      [](char c) {
        const bool isLetterOrDigit = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9');
        return !isLetterOrDigit && c != '-' && c != '_' && c != '.';
      },
      '_');
  return stem;
}

/// Medians over the seed sets; for the average error also its least and greatest value.
ShareResult summaryOf(const std::vector<ShareResult>& samples) {
  ShareResult result = samples.front();
  const auto [least, greatest] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const ShareResult& a, const ShareResult& b) { return a.averageError < b.averageError; });
  result.leastAverageError = least->averageError;
  result.greatestAverageError = greatest->averageError;
  for (double ShareResult::*field :
       {&ShareResult::averageError, &ShareResult::maximumError, &ShareResult::truthAverageError,
        &ShareResult::truthMaximumError, &ShareResult::estimatedError, &ShareResult::sampleSeconds,
        &ShareResult::traceSeconds, &ShareResult::predictSeconds, &ShareResult::solveSeconds,
        &ShareResult::timeRatio}) {
    std::vector<double> values;
    for (const ShareResult& sample : samples)
      if (!std::isnan(sample.*field)) values.push_back(sample.*field);
    result.*field = values.empty() ? kNoValue : dispersionOf(values).median;
  }
  return result;
}

double rangeOf(const Result& result) { return result.report.sdf.max - result.report.sdf.min; }

ShareResult compare(const Result& result, const Result& full, const Result& truth, double percent,
                    double fullTraceSeconds) {
  const FieldErrors errors = errorsOverRange(full.sdf(), result.sdf());
  const FieldErrors truthErrors = errorsOverRange(truth.sdf(), result.sdf());
  const double scale = rangeOf(truth) / rangeOf(full);
  const StageSeconds& seconds = result.report.stageSeconds;
  return {
      .percent = percent,
      .seedCount = result.report.seedCount,
      .averageError = errors.average,
      .maximumError = errors.maximum,
      .truthAverageError = truthErrors.average * scale,
      .truthMaximumError = truthErrors.maximum * scale,
      .estimatedError = result.report.estimatedError ? result.report.estimatedError->average : kNoValue,
      .sampleSeconds = seconds[Stage::Sample],
      .traceSeconds = seconds[Stage::Trace],
      .predictSeconds = seconds[Stage::Predict],
      .solveSeconds = seconds[Stage::Solve],
      .timeRatio = (seconds[Stage::Sample] + seconds[Stage::Trace] + seconds[Stage::Predict] + seconds[Stage::Solve]) /
                   fullTraceSeconds};
}

}  // namespace

std::vector<NamedMesh> readMeshes(const std::vector<std::string>& paths) {
  std::vector<NamedMesh> meshes;
  std::set<std::string> names;
  for (const std::string& path : paths) {
    const std::string stem = plainStem(path);
    std::string name = stem;
    for (int number = 2; !names.insert(name).second; ++number) name = fmt::format("{}-{}", stem, number);
    meshes.push_back({name, readMesh(path)});
  }
  return meshes;
}

std::vector<NamedMesh> generateMeshes(uint64_t faceCount) {
  std::vector<NamedMesh> meshes;
  for (const char* shape : {"animal", "hand", "figure"})
    meshes.push_back({shape, generateShape(shape, faceCount).mesh, {.up = Up::Z}});
  return meshes;
}

Evaluation evaluate(Session& session, NamedMesh& mesh, const EvaluationOptions& options, const RunControl& control) {
  const auto compute = [&](const Options& computation) { return session.compute(mesh.mesh, computation, control); };
  writeProgress(mesh.name + ": warm-up");
  for (const auto& [recipeName, recipe] : kRecipes) static_cast<void>(compute(recipeOptions(recipe, 1)));
  Options fullOptions = recipeOptions(Recipe::Paper, 100);
  fullOptions.keepsScene = true;
  Evaluation evaluation{.name = mesh.name, .full = compute(fullOptions), .recipes = {}};
  mesh.scene = evaluation.full.scene;
  if (!(evaluation.range() > 0))
    throw std::runtime_error(mesh.name + ": all values are equal, so errors divided by their range are undefined");
  writeProgress(fmt::format("{}: {} rays at each of {} faces", mesh.name, options.truthRayCount,
                            evaluation.full.report.faceCount));
  const Result truth = compute(truthOptions(options.truthRayCount));

  std::array<std::array<std::vector<ShareResult>, kPercents.size()>, kRecipes.size()> samples;
  std::vector<double> fullTraceSeconds;
  for (uint32_t round = 1; round <= options.seedSetCount; ++round) {
    writeProgress(fmt::format("{}: seed set {} of {}", mesh.name, round, options.seedSetCount));
    static_assert(kPercents[0] == 100 && kRecipes[0].second == Recipe::Paper);  // The first entry is the full trace.
    for (size_t i = 0; i < kPercents.size(); ++i)
      for (size_t j = 0; j < kRecipes.size(); ++j) {
        const Result result = compute(recipeOptions(kRecipes[j].second, kPercents[i], round));
        if (i == 0 && j == 0) fullTraceSeconds.push_back(result.report.stageSeconds[Stage::Trace]);
        samples[j][i].push_back(compare(result, evaluation.full, truth, kPercents[i], fullTraceSeconds.back()));
      }
  }
  evaluation.fullTraceSeconds = dispersionOf(fullTraceSeconds).median;
  for (size_t j = 0; j < kRecipes.size(); ++j)
    for (size_t i = 0; i < kPercents.size(); ++i) evaluation.recipes[j][i] = summaryOf(samples[j][i]);
  return evaluation;
}

}  // namespace asdfvk::bench
