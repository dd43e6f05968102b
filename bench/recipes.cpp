// Measures the accuracy of the recipes over many meshes. Prints errors against the full function and against values
// from many rays, the estimated error divided by the actual error, and the cost. The recipes were tuned on meshes at
// odd places of the list (sorted by name, models/ before psb/off). Therefore the summary separates odd and even places.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "asdf_vk/files.h"
#include "support/computation.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

constexpr std::array<double, 3> kEstimatedPercents{5, 10, 20};
constexpr double kMaxError = 0.01, kMaxRelativeError = 0.05;

struct EstimateRatios {
  double average = 0, robustAverage = 0, relativeMedian = 0, relativePercentile90 = 0;
};
struct NamedRatio {
  const char* name;
  double EstimateRatios::*ratio;
};
constexpr std::array<NamedRatio, 4> kEstimateRatios{
    {{"average", &EstimateRatios::average},
     {"robust average", &EstimateRatios::robustAverage},
     {"median of the relative error", &EstimateRatios::relativeMedian},
     {"90th percentile of the relative error", &EstimateRatios::relativePercentile90}}};

EstimateRatios ratiosOf(const ErrorEstimate& estimate, const FieldErrors& actual) {
  const auto over = [](double a, double b) { return a == b ? 1 : a / b; };
  return {over(estimate.average, actual.average), over(estimate.robustAverage, actual.robustAverage),
          over(estimate.relativeMedian, actual.relativeMedian),
          over(estimate.relativePercentile90, actual.relativePercentile90)};
}

/// A computation that is compared with the truth.
struct TruthRun {
  const char* name;
  Recipe recipe;
  std::optional<double> percent;  ///< Unset: the default number of seeds.
};
constexpr std::array<TruthRun, 6> kTruthRuns{{{"balanced 5 %", Recipe::Balanced, 5},
                                              {"balanced 10 %", Recipe::Balanced, 10},
                                              {"balanced, default seeds", Recipe::Balanced, std::nullopt},
                                              {"quality 5 %", Recipe::Quality, 5},
                                              {"quality 10 %", Recipe::Quality, 10},
                                              {"quality 40 %", Recipe::Quality, 40}}};

/// Average differences from reference values, divided by the range of the reference values. The full function is the
/// values from 30 rays at every face with fixed cones. The truth is the values from many rays at every face with hashed
/// cones. The floor is the error of the full function against the truth.
struct MeshRow {
  std::string name;
  uint64_t faceCount = 0;
  double paper = 0, balanced = 0;  ///< At 10 %, against the full function.
  double byDefault = 0;            ///< Balanced with the default number of seeds, against the full function.
  std::array<double, kTruthRuns.size()> overFloor{};                ///< Against the truth, divided by the floor.
  std::array<EstimateRatios, kEstimatedPercents.size()> estimates;  ///< For the recipe balanced.
  double boundedError = 0;                                          ///< Balanced with --max-error 1%: actual error.
  double boundedShare = 0;          ///< Balanced with --max-error 1%: seeds divided by faces.
  double boundedRelativeError = 0;  ///< Balanced with --max-error 5%rel: median relative error.
  double boundedRelativeShare = 0;  ///< Balanced with --max-error 5%rel: seeds divided by faces.
  double iterations = 0;            ///< Solver iterations with 10 % seeds: recipe balanced / recipe paper.
  /// Balanced with 10 % seeds: time of the stages sample, predict and solve / time of the stage trace.
  double overTrace = 0;
};

struct Settings {
  uint32_t truthRayCount = 600;
  uint64_t randomSeed = 1;
  bool onlyEstimates = false;
};

MeshRow measure(Session& session, const std::string& path, const Settings& settings, const RunControl& control) {
  MeshRow row;
  row.name = path.substr(path.rfind('/') + 1);
  const Mesh mesh = readMesh(path);
  const auto compute = [&](const Options& options) { return session.compute(mesh, options, control); };
  const auto shareOf = [](const Result& result) {
    return static_cast<double>(result.report.seedCount) / static_cast<double>(result.report.faceCount);
  };
  const auto options = [&](Recipe recipe, double percent) {
    return recipeOptions(recipe, percent, settings.randomSeed);
  };
  const Result full = compute(options(Recipe::Paper, 100));
  row.faceCount = full.report.faceCount;
  const auto errors = [&](const Result& result) { return errorsOverRange(full.sdf(), result.sdf()); };
  Result balanced;  // The result with 10 % seeds.
  for (size_t i = 0; i < kEstimatedPercents.size(); ++i) {
    Result result = compute(options(Recipe::Balanced, kEstimatedPercents[i]));
    if (result.report.estimatedError) row.estimates[i] = ratiosOf(*result.report.estimatedError, errors(result));
    if (kEstimatedPercents[i] == 10) balanced = std::move(result);
  }
  if (settings.onlyEstimates) return row;

  const Result truth = compute(truthOptions(settings.truthRayCount));
  const auto truthError = [&](const Result& result) { return errorsOverRange(truth.sdf(), result.sdf()).average; };
  const double floor = truthError(full);
  for (size_t i = 0; i < kTruthRuns.size(); ++i) {
    const TruthRun& run = kTruthRuns[i];
    Options runOptions = options(run.recipe, run.percent.value_or(10));
    if (!run.percent) runOptions.seeds = Options().seeds;
    const Result result = compute(runOptions);
    row.overFloor[i] = truthError(result) / floor;
    if (!run.percent) row.byDefault = errors(result).average;
  }
  const Result paper = compute(options(Recipe::Paper, 10));
  row.paper = errors(paper).average;
  row.balanced = errors(balanced).average;
  row.iterations =
      static_cast<double>(balanced.report.solver.iterations) / std::max(1u, paper.report.solver.iterations);
  const StageSeconds& seconds = balanced.report.stageSeconds;
  row.overTrace = (seconds[Stage::Sample] + seconds[Stage::Predict] + seconds[Stage::Solve]) / seconds[Stage::Trace];
  Options bounded = options(Recipe::Balanced, 2);
  bounded.rounds.maxError = kMaxError;
  const Result boundedResult = compute(bounded);
  row.boundedError = errors(boundedResult).average;
  row.boundedShare = shareOf(boundedResult);
  bounded.rounds = {};
  bounded.rounds.maxRelativeError = kMaxRelativeError;
  const Result boundedRelative = compute(bounded);
  row.boundedRelativeError = errors(boundedRelative).relativeMedian;
  row.boundedRelativeShare = shareOf(boundedRelative);
  return row;
}

template <typename Value>
std::vector<double> valuesOf(const std::vector<MeshRow>& rows, const Value& value) {
  std::vector<double> values;
  for (const MeshRow& row : rows) values.push_back(value(row));
  return values;
}

std::vector<double> valuesOf(const std::vector<MeshRow>& rows, double MeshRow::*member) {
  return valuesOf(rows, [member](const MeshRow& row) { return row.*member; });
}

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double geometricMeanOf(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return std::exp(meanOf(values));
}

double maximumOf(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

std::string meanAndMaximum(const std::vector<double>& values, int decimals) {
  return fmt::format("mean {:.{}f}, maximum {:.{}f}", meanOf(values), decimals, maximumOf(values), decimals);
}

double percentWithin(const std::vector<double>& values, double low, double high) {
  const auto count = std::count_if(values.begin(), values.end(), [&](double v) { return v >= low && v <= high; });
  return 100 * static_cast<double>(count) / static_cast<double>(values.size());
}

std::string estimateSummary(const std::vector<MeshRow>& rows) {
  std::string text;
  for (const NamedRatio& kind : kEstimateRatios) {
    std::vector<double> all;
    for (size_t i = 0; i < kEstimatedPercents.size(); ++i) {
      const auto ratios = valuesOf(rows, [&](const MeshRow& row) { return row.estimates[i].*kind.ratio; });
      all.insert(all.end(), ratios.begin(), ratios.end());
      text += fmt::format(
          "  estimated / actual {} at {:g} %: geometric mean {:.3f}, within .75 to 1.33: {:.1f} %, within .67 to 1.5: "
          "{:.1f} %\n",
          kind.name, kEstimatedPercents[i], geometricMeanOf(ratios), percentWithin(ratios, .75, 1.33),
          percentWithin(ratios, .67, 1.5));
    }
    text +=
        fmt::format("  estimated / actual {}, all shares: within .75 to 1.33: {:.1f} %, within .67 to 1.5: {:.1f} %\n",
                    kind.name, percentWithin(all, .75, 1.33), percentWithin(all, .67, 1.5));
  }
  return text;
}

std::string recipeSummary(const std::vector<MeshRow>& rows) {
  const auto ratios = valuesOf(rows, [](const MeshRow& row) { return row.balanced / row.paper; });
  const std::vector<double> bounded = valuesOf(rows, &MeshRow::boundedError),
                            boundedRelative = valuesOf(rows, &MeshRow::boundedRelativeError);
  std::string text = fmt::format("  error with 10 % seeds, balanced / paper: geometric mean {:.3f}, maximum {:.3f}\n",
                                 geometricMeanOf(ratios), maximumOf(ratios));
  text += fmt::format("  error with the default number of seeds: {}\n",
                      meanAndMaximum(valuesOf(rows, &MeshRow::byDefault), 4));
  for (size_t i = 0; i < kTruthRuns.size(); ++i)
    text += fmt::format("  error against the truth / floor, {}: {}\n", kTruthRuns[i].name,
                        meanAndMaximum(valuesOf(rows, [i](const MeshRow& row) { return row.overFloor[i]; }), 3));
  text += fmt::format(
      "  --max-error 1%: actual error at most 1.2 % on {:.1f} % of the meshes, maximum {:.2f} %; mean share of seeds "
      "{:.1f} %\n",
      percentWithin(bounded, 0, .012), 100 * maximumOf(bounded), 100 * meanOf(valuesOf(rows, &MeshRow::boundedShare)));
  text += fmt::format(
      "  --max-error 5%rel: actual median at most 6 % on {:.1f} % of the meshes, maximum {:.2f} %; mean share of seeds "
      "{:.1f} %\n",
      percentWithin(boundedRelative, 0, .06), 100 * maximumOf(boundedRelative),
      100 * meanOf(valuesOf(rows, &MeshRow::boundedRelativeShare)));
  text += fmt::format("  solver iterations, balanced / paper: {}\n",
                      meanAndMaximum(valuesOf(rows, &MeshRow::iterations), 2));
  return text + fmt::format("  (sample + predict + solve) / trace, with 10 % seeds: {}\n",
                            meanAndMaximum(valuesOf(rows, &MeshRow::overTrace), 2));
}

std::string summaryOf(const char* title, const std::vector<MeshRow>& rows, bool onlyEstimates) {
  if (rows.empty()) return {};
  return fmt::format("\n{} ({} meshes)\n", title, rows.size()) + estimateSummary(rows) +
         (onlyEstimates ? "" : recipeSummary(rows));
}

/// For example "1.02 0.99 1.01", one ratio per share of seeds.
std::string toText(const MeshRow& row, double EstimateRatios::*ratio) {
  std::string text;
  for (const EstimateRatios& ratios : row.estimates)
    text += fmt::format("{}{:.2f}", text.empty() ? "" : " ", ratios.*ratio);
  return text;
}

std::string toText(const MeshRow& row, bool onlyEstimates) {
  std::string text = fmt::format("| {} | {} |", row.name, row.faceCount);
  for (const NamedRatio& kind : kEstimateRatios) text += fmt::format(" {} |", toText(row, kind.ratio));
  if (onlyEstimates) return text + "\n";
  text += fmt::format(" {:.4f} | {:.4f} | {:.3f} | {:.4f} |", row.paper, row.balanced, row.balanced / row.paper,
                      row.byDefault);
  for (const double overFloor : row.overFloor) text += fmt::format(" {:.3f} |", overFloor);
  return text + fmt::format(" {:.4f} ({:.1f} %) | {:.4f} ({:.1f} %) |\n", row.boundedError, 100 * row.boundedShare,
                            row.boundedRelativeError, 100 * row.boundedRelativeShare);
}

std::string headerOf(bool onlyEstimates) {
  std::string header = "| mesh | faces |", line = "|---|---|";
  const auto add = [&](const std::string& column) {
    header += fmt::format(" {} |", column);
    line += "---|";
  };
  for (const NamedRatio& kind : kEstimateRatios) add(fmt::format("estimated / actual {} at 5, 10, 20 %", kind.name));
  if (onlyEstimates) return header + "\n" + line + "\n";
  for (const char* column : {"paper 10 %", "balanced 10 %", "balanced / paper", "balanced, default seeds"}) add(column);
  for (const TruthRun& run : kTruthRuns) add(fmt::format("{} / floor", run.name));
  for (const char* column : {"--max-error 1% (seeds)", "--max-error 5%rel (seeds)"}) add(column);
  return header + "\n" + line + "\n";
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-recipes", "Errors, error estimates and cost of the recipes over many meshes.");
  std::vector<std::string> meshes;
  std::string backend = "vulkan", device;
  Settings settings;
  program.addMeshes(meshes);
  program.add("--backend", backend, "vulkan, cpu or reference");
  program.add("--device", device, "Vulkan device: index or part of its name");
  program.add("--truth-rays", settings.truthRayCount, "Rays per face of the truth", {31, kMaxRayCount});
  program.add("--rng-seed", settings.randomSeed, "Random seed of the samplers");
  program.add("--only-estimates", settings.onlyEstimates,
              "Only the error estimates of the recipe balanced; takes a tenth of the time");
  return program.run(argc, argv, [&](const RunControl& control) {
    Session session(sessionOptionsOf(backend, device));
    std::vector<MeshRow> rows, odd, even;
    writeOutput(headerOf(settings.onlyEstimates));
    for (const std::string& mesh : meshes) {
      rows.push_back(measure(session, mesh, settings, control));
      (rows.size() % 2 == 1 ? odd : even).push_back(rows.back());
      writeOutput(toText(rows.back(), settings.onlyEstimates));
    }
    writeOutput(summaryOf("odd places", odd, settings.onlyEstimates) +
                summaryOf("even places", even, settings.onlyEstimates) +
                summaryOf("all", rows, settings.onlyEstimates));
  });
}
