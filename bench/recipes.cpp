// What the recipes are worth over many meshes: errors against the full function and against one of many rays, the
// estimate of the error against the error, and what it costs. Constants were tuned on meshes at odd places of the list
// (sorted by name, models/ before psb/off); the summary therefore tells both halves apart.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench_program.h"
#include "cli/terminal.h"
#include "file_run.h"
#include "io/mesh_reader.h"
#include "share_errors.h"

namespace {

using namespace asdfvk;

constexpr std::array<double, 3> kEstimatedPercents{5, 10, 20};

/// All errors over the range.
struct MeshRow {
  std::string name;
  uint64_t faceCount = 0;
  double paper = 0, balanced = 0, quality = 0;  ///< At 10 %, against the full function of fixed cones.
  double balancedTruth = 0, qualityTruth = 0;   ///< At 10 %, against many rays, over the full function's own.
  double qualityTruthAt40 = 0;                  ///< At 40 %, likewise.
  std::array<double, kEstimatedPercents.size()> estimate{};  ///< Balanced, over the real error.
  double boundedError = 0;                                   ///< Balanced, --max-error 1%.
  double boundedShare = 0;                                   ///< Of the faces, that took.
  double iterations = 0;                                     ///< Of balanced over paper's, at 10 %.
  double overTrace = 0;  ///< Sample, predict and solve over trace, balanced at 10 %.
};

Options optionsOf(Recipe recipe, double percent) {
  Options options;
  applyRecipe(recipe, options);
  options.seeds = {SeedCount::Kind::Share, percent / 100, 0};
  if (percent == 100) options.seeds.kind = SeedCount::Kind::All;
  return options;
}

MeshRow measure(Session& session, const std::string& path, uint32_t truthRayCount, const RunControl& control) {
  MeshRow row;
  row.name = path.substr(path.rfind('/') + 1);
  Mesh mesh = readMesh(path);
  const auto compute = [&](const Options& options) { return session.compute(mesh, options, control); };
  const Result full = compute(optionsOf(Recipe::Paper, 100));
  Options many = optionsOf(Recipe::Paper, 100);
  many.cone.rayCount = truthRayCount;
  many.cone.rotation = ConeRotation::Hashed;
  const Result truth = compute(many);
  const auto error = [&](const Result& result) { return bench::errorsOverRange(full.sdf, result.sdf).average; };
  const auto truthError = [&](const Result& result) { return bench::errorsOverRange(truth.sdf, result.sdf).average; };
  const double floor = truthError(full);

  row.faceCount = full.report.faceCount;
  const Result paper = compute(optionsOf(Recipe::Paper, 10));
  row.paper = error(paper);
  for (size_t i = 0; i < kEstimatedPercents.size(); ++i) {
    const Result balanced = compute(optionsOf(Recipe::Balanced, kEstimatedPercents[i]));
    if (balanced.report.estimatedError) row.estimate[i] = balanced.report.estimatedError->average / error(balanced);
    if (kEstimatedPercents[i] != 10) continue;
    row.balanced = error(balanced);
    row.balancedTruth = truthError(balanced) / floor;
    row.iterations =
        static_cast<double>(balanced.report.solver.iterations) / std::max(1u, paper.report.solver.iterations);
    const StageSeconds& seconds = balanced.report.stageSeconds;
    row.overTrace = (seconds.sample + seconds.predict + seconds.solve) / seconds.trace;
  }
  const Result quality = compute(optionsOf(Recipe::Quality, 10));
  row.quality = error(quality);
  row.qualityTruth = truthError(quality) / floor;
  row.qualityTruthAt40 = truthError(compute(optionsOf(Recipe::Quality, 40))) / floor;
  Options bounded = optionsOf(Recipe::Balanced, 2);
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

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double geometricMean(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return std::exp(mean(values));
}

double greatest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

double shareWithin(const std::vector<double>& values, double low, double high) {
  return static_cast<double>(
             std::count_if(values.begin(), values.end(), [&](double v) { return v >= low && v <= high; })) /
         static_cast<double>(values.size());
}

std::string summaryOf(const char* title, const std::vector<MeshRow>& rows) {
  if (rows.empty()) return {};
  const auto ratios = valuesOf(rows, [](const MeshRow& row) { return row.balanced / row.paper; });
  const auto truth = valuesOf(rows, [](const MeshRow& row) { return row.qualityTruth; });
  const auto truthAt40 = valuesOf(rows, [](const MeshRow& row) { return row.qualityTruthAt40; });
  const auto bounded = valuesOf(rows, [](const MeshRow& row) { return row.boundedError; });
  const auto iterations = valuesOf(rows, [](const MeshRow& row) { return row.iterations; });
  const auto overTrace = valuesOf(rows, [](const MeshRow& row) { return row.overTrace; });
  std::string text = fmt::format("\n{} ({} meshes)\n", title, rows.size());
  text += fmt::format("  balanced / paper, error at 10 %: geometric mean {:.3f}, greatest {:.3f}\n",
                      geometricMean(ratios), greatest(ratios));
  text += fmt::format(
      "  quality, error against many rays / the full function's own: mean {:.3f} at 10 % (greatest {:.3f}), "
      "{:.3f} at 40 % (greatest {:.3f}); balanced at 10 %: mean {:.3f}\n",
      mean(truth), greatest(truth), mean(truthAt40), greatest(truthAt40),
      mean(valuesOf(rows, [](const MeshRow& row) { return row.balancedTruth; })));
  std::vector<double> all;
  for (size_t i = 0; i < kEstimatedPercents.size(); ++i) {
    const auto estimates = valuesOf(rows, [&](const MeshRow& row) { return row.estimate[i]; });
    all.insert(all.end(), estimates.begin(), estimates.end());
    text += fmt::format("  estimated / real error at {:g} %: geometric mean {:.3f}, within .75 to 1.33: {:.1f} %\n",
                        kEstimatedPercents[i], geometricMean(estimates), 100 * shareWithin(estimates, .75, 1.33));
  }
  text += fmt::format("  of all those: {:.1f} %\n", 100 * shareWithin(all, .75, 1.33));
  text += fmt::format(
      "  --max-error 1%: real error at most 1.2 % on {:.1f} %, greatest {:.2f} %; mean share of seeds {:.1f} %\n",
      100 * shareWithin(bounded, 0, .012), 100 * greatest(bounded),
      100 * mean(valuesOf(rows, [](const MeshRow& row) { return row.boundedShare; })));
  text += fmt::format("  iterations, balanced / paper: mean {:.2f}, greatest {:.2f}\n", mean(iterations),
                      greatest(iterations));
  return text + fmt::format("  (sample + predict + solve) / trace at 10 %: mean {:.2f}, greatest {:.2f}\n",
                            mean(overTrace), greatest(overTrace));
}

std::string rowText(const MeshRow& row) {
  return fmt::format(
      "| {} | {} | {:.4f} | {:.4f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.2f} {:.2f} {:.2f} | {:.4f} ({:.1f} %) |\n",
      row.name, row.faceCount, row.paper, row.balanced, row.balanced / row.paper, row.balancedTruth, row.qualityTruth,
      row.qualityTruthAt40, row.estimate[0], row.estimate[1], row.estimate[2], row.boundedError,
      100 * row.boundedShare);
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-recipes",
                              "What the recipes are worth over many meshes: errors, their estimates and costs.");
  std::vector<std::string> meshes;
  std::string backend = "vulkan", device;
  uint32_t truthRayCount = 600;
  program.addMeshes(meshes);
  program.add("--backend", backend, "vulkan, cpu or reference");
  program.add("--device", device, "As asdf-vk takes it");
  program.add("--truth-rays", truthRayCount, "Rays per cone of the function of many rays", {31, kMaxRayCount});
  return program.run(argc, argv, [&](const RunControl& control) {
    Session session(bench::sessionOptionsOf(backend, device));
    std::vector<MeshRow> rows, odd, even;
    writeStandardOutput(
        "| mesh | faces | paper, 10 % | balanced | ratio | balanced / floor | quality / floor | quality 40 % / floor | "
        "estimate / error at 5, 10, 20 % | --max-error 1% |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& mesh : meshes) {
      rows.push_back(measure(session, mesh, truthRayCount, control));
      (rows.size() % 2 == 1 ? odd : even).push_back(rows.back());
      writeStandardOutput(rowText(rows.back()));
    }
    writeStandardOutput(summaryOf("odd places", odd) + summaryOf("even places", even) + summaryOf("all", rows));
  });
}
