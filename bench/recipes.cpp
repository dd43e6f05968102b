// How accurate are the recipes over many meshes? Errors against the full function and against one of many rays, the
// estimated error over the actual one, and the cost. The constants of the recipes were tuned on the meshes at odd
// places of the list (sorted by name, models/ before psb/off); therefore the summary separates odd and even places.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asdf_vk/files.h"
#include "support/computation.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

constexpr std::array<double, 3> kEstimatedPercents{5, 10, 20};

/// Average errors over the range of the reference. Full: the function of 30 rays at every face, fixed cones. Truth:
/// many rays at every face, hashed cones. Floor: the error of the full function against the truth.
struct MeshRow {
  std::string name;
  uint64_t faceCount = 0;
  double paper = 0, balanced = 0, quality = 0;               ///< At 10 %, against the full function.
  double balancedTruth = 0, qualityTruth = 0;                ///< At 10 %, against the truth, over the floor.
  double qualityTruthAt40 = 0;                               ///< At 40 %, likewise.
  std::array<double, kEstimatedPercents.size()> estimate{};  ///< Balanced: estimated over actual error.
  double boundedError = 0;                                   ///< Balanced, --max-error 1%: actual error.
  double boundedShare = 0;                                   ///< Likewise: share of the faces that are seeds.
  double iterations = 0;                                     ///< Solver iterations, balanced over paper, at 10 %.
  double overTrace = 0;  ///< Time of sample, predict and solve over that of trace, balanced at 10 %.
};

MeshRow measure(Session& session, const std::string& path, uint32_t truthRayCount, const RunControl& control) {
  MeshRow row;
  row.name = path.substr(path.rfind('/') + 1);
  const Mesh mesh = readMesh(path);
  const auto compute = [&](const Options& options) { return session.compute(mesh, options, control); };
  const Result full = compute(recipeOptions(Recipe::Paper, 100));
  const Result truth = compute(truthOptions(truthRayCount));
  const auto error = [&](const Result& result) { return errorsOverRange(full.sdf(), result.sdf()).average; };
  const auto truthError = [&](const Result& result) { return errorsOverRange(truth.sdf(), result.sdf()).average; };
  const double floor = truthError(full);

  row.faceCount = full.report.faceCount;
  const Result paper = compute(recipeOptions(Recipe::Paper, 10));
  row.paper = error(paper);
  for (size_t i = 0; i < kEstimatedPercents.size(); ++i) {
    const Result balanced = compute(recipeOptions(Recipe::Balanced, kEstimatedPercents[i]));
    if (balanced.report.estimatedError) row.estimate[i] = balanced.report.estimatedError->average / error(balanced);
    if (kEstimatedPercents[i] != 10) continue;
    row.balanced = error(balanced);
    row.balancedTruth = truthError(balanced) / floor;
    row.iterations =
        static_cast<double>(balanced.report.solver.iterations) / std::max(1u, paper.report.solver.iterations);
    const StageSeconds& seconds = balanced.report.stageSeconds;
    row.overTrace = (seconds[Stage::Sample] + seconds[Stage::Predict] + seconds[Stage::Solve]) / seconds[Stage::Trace];
  }
  const Result quality = compute(recipeOptions(Recipe::Quality, 10));
  row.quality = error(quality);
  row.qualityTruth = truthError(quality) / floor;
  row.qualityTruthAt40 = truthError(compute(recipeOptions(Recipe::Quality, 40))) / floor;
  Options bounded = recipeOptions(Recipe::Balanced, 2);
  bounded.rounds.maxError = 0.01;
  const Result boundedResult = compute(bounded);
  row.boundedError = error(boundedResult);
  row.boundedShare = static_cast<double>(boundedResult.report.seedCount) / static_cast<double>(row.faceCount);
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

/// "mean 0.912, maximum 1.034"
std::string meanAndMaximum(const std::vector<double>& values, int decimals) {
  return fmt::format("mean {:.{}f}, maximum {:.{}f}", meanOf(values), decimals, maximumOf(values), decimals);
}

double percentWithin(const std::vector<double>& values, double low, double high) {
  const auto count = std::count_if(values.begin(), values.end(), [&](double v) { return v >= low && v <= high; });
  return 100 * static_cast<double>(count) / static_cast<double>(values.size());
}

std::string summaryOf(const char* title, const std::vector<MeshRow>& rows) {
  if (rows.empty()) return {};
  const auto ratios = valuesOf(rows, [](const MeshRow& row) { return row.balanced / row.paper; });
  const std::vector<double> bounded = valuesOf(rows, &MeshRow::boundedError);
  std::string text = fmt::format("\n{} ({} meshes)\n", title, rows.size());
  text += fmt::format("  error at 10 %, balanced / paper: geometric mean {:.3f}, maximum {:.3f}\n",
                      geometricMeanOf(ratios), maximumOf(ratios));
  text +=
      fmt::format("  error against the truth / floor: quality at 10 % {}; quality at 40 % {}; balanced at 10 % {}\n",
                  meanAndMaximum(valuesOf(rows, &MeshRow::qualityTruth), 3),
                  meanAndMaximum(valuesOf(rows, &MeshRow::qualityTruthAt40), 3),
                  meanAndMaximum(valuesOf(rows, &MeshRow::balancedTruth), 3));
  std::vector<double> all;
  for (size_t i = 0; i < kEstimatedPercents.size(); ++i) {
    const auto estimates = valuesOf(rows, [&](const MeshRow& row) { return row.estimate[i]; });
    all.insert(all.end(), estimates.begin(), estimates.end());
    text += fmt::format("  estimated / actual error at {:g} %: geometric mean {:.3f}, within .75 to 1.33: {:.1f} %\n",
                        kEstimatedPercents[i], geometricMeanOf(estimates), percentWithin(estimates, .75, 1.33));
  }
  text += fmt::format("  estimated / actual error, all shares: within .75 to 1.33: {:.1f} %\n",
                      percentWithin(all, .75, 1.33));
  text += fmt::format(
      "  --max-error 1%: actual error at most 1.2 % on {:.1f} % of the meshes, maximum {:.2f} %; mean share of seeds "
      "{:.1f} %\n",
      percentWithin(bounded, 0, .012), 100 * maximumOf(bounded), 100 * meanOf(valuesOf(rows, &MeshRow::boundedShare)));
  text += fmt::format("  solver iterations, balanced / paper: {}\n",
                      meanAndMaximum(valuesOf(rows, &MeshRow::iterations), 2));
  return text + fmt::format("  (sample + predict + solve) / trace at 10 %: {}\n",
                            meanAndMaximum(valuesOf(rows, &MeshRow::overTrace), 2));
}

std::string toText(const MeshRow& row) {
  return fmt::format(
      "| {} | {} | {:.4f} | {:.4f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.2f} {:.2f} {:.2f} | {:.4f} ({:.1f} %) |\n",
      row.name, row.faceCount, row.paper, row.balanced, row.balanced / row.paper, row.balancedTruth, row.qualityTruth,
      row.qualityTruthAt40, row.estimate[0], row.estimate[1], row.estimate[2], row.boundedError,
      100 * row.boundedShare);
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-recipes", "Errors, error estimates and cost of the recipes over many meshes.");
  std::vector<std::string> meshes;
  std::string backend = "vulkan", device;
  uint32_t truthRayCount = 600;
  program.addMeshes(meshes);
  program.add("--backend", backend, "vulkan, cpu or reference");
  program.add("--device", device, "Vulkan device: index or part of its name");
  program.add("--truth-rays", truthRayCount, "Rays per face of the truth", {31, kMaxRayCount});
  return program.run(argc, argv, [&](const RunControl& control) {
    Session session(sessionOptionsOf(backend, device));
    std::vector<MeshRow> rows, odd, even;
    writeOutput(
        "| mesh | faces | paper, 10 % | balanced | ratio | balanced / floor | quality / floor | quality 40 % / floor | "
        "estimated / actual error at 5, 10, 20 % | --max-error 1% (seeds) "
        "|\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& mesh : meshes) {
      rows.push_back(measure(session, mesh, truthRayCount, control));
      (rows.size() % 2 == 1 ? odd : even).push_back(rows.back());
      writeOutput(toText(rows.back()));
    }
    writeOutput(summaryOf("odd places", odd) + summaryOf("even places", even) + summaryOf("all", rows));
  });
}
