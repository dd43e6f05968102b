#include "paper/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "paper/laplacian.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace asdfvk::bench {
namespace {

constexpr const char* kSdfTitle = "SDF";
// The colours do not change above these percentiles, because single faces have much greater values.
constexpr double kLaplacianPercentile = 0.99, kErrorPercentile = 0.98;

std::string errorCaption(const std::string& name, const Evaluation& evaluation, const Result& result) {
  const FieldErrors errors = errorsOverRange(evaluation.full.sdf(), result.sdf());
  return fmt::format("{}: average error {:.4f}, maximum {:.3f}", name, errors.average, errors.maximum);
}

void drawLaplacian(PictureWriter& pictures, const NamedMesh& mesh, const Evaluation& evaluation) {
  std::vector<double> values = absoluteLaplacian(mesh.mesh, toTriangles(mesh.mesh, evaluation.full.sdf()));
  const double top = percentileOf(values, kLaplacianPercentile);
  for (double& value : values) value = top > 0 ? value / top : 0 * value;
  const auto low = std::count_if(values.begin(), values.end(), [](double v) { return v < 0.1; });
  const auto present = std::count_if(values.begin(), values.end(), [](double v) { return !std::isnan(v); });
  pictures.drawTriangleField(
      2, "figure2-laplacian", mesh, values, {"|Laplacian|", {0, 1}},
      fmt::format("Laplacian of the full function over its 99th percentile; below 0.1 on {:.0f} % of the faces",
                  100.0 * static_cast<double>(low) / static_cast<double>(std::max<std::ptrdiff_t>(1, present))));
}

void drawErrors(PictureWriter& pictures, const NamedMesh& mesh, const Evaluation& evaluation, const Result& paper,
                const Result& balanced) {
  const auto errorsOf = [&](const Result& result) {
    std::vector<double> errors(result.sdf().size());
    for (size_t i = 0; i < errors.size(); ++i)
      errors[i] = std::abs(result.sdf()[i] - evaluation.full.sdf()[i]) / evaluation.range();
    return errors;
  };
  const std::vector<double> paperErrors = errorsOf(paper), balancedErrors = errorsOf(balanced);
  const FieldStyle style{"|error| / range", {0, percentileOf(paperErrors, kErrorPercentile)}};
  if (balanced.report.estimatedError) {
    std::vector<double> expected = *balanced.field("error")->reals();
    for (double& error : expected) error /= evaluation.range();
    pictures.drawField(
        4, "figure4-expected", mesh, expected, style,
        fmt::format("balanced, expected error: average {:.4f}", balanced.report.estimatedError->average));
  }
  pictures.drawField(4, "figure4-error-paper", mesh, paperErrors, style, errorCaption("paper", evaluation, paper));
  pictures.drawField(4, "figure4-error-balanced", mesh, balancedErrors, style,
                     errorCaption("balanced", evaluation, balanced));
}

Options samplerOptions(SamplerChoice sampler, Recipe recipe, uint64_t randomSeed) {
  Options options = recipeOptions(recipe, kSamplerPercent, randomSeed);
  options.sampler = sampler;
  options.estimatesError = false;  // No error estimate, because its held-out faces would be random seeds.
  return options;
}

}  // namespace

void drawMeshFigures(PictureWriter& pictures, FigurePages& pages, Session& session, NamedMesh& mesh,
                     const Evaluation& evaluation, const RunControl& control) {
  const auto compute = [&](Recipe recipe, double percent) {
    return session.compute(mesh.mesh, recipeOptions(recipe, percent), control);
  };
  const Result paper = compute(Recipe::Paper, kFigurePercent), balanced = compute(Recipe::Balanced, kFigurePercent);
  const FieldStyle style{kSdfTitle, percentileRange(evaluation.full.sdf())};
  const auto draw = [&](int figure, const std::string& name, const Result& result, const std::string& caption) {
    pictures.drawField(figure, name, mesh, result.sdf(), style, caption);
    pages.add(figure, mesh, result, caption);
  };
  const auto seedCaption = [](const char* recipe, const Result& result) {
    return fmt::format("{}: {} seeds", recipe, groupDigits(result.report.seedCount));
  };
  pictures.drawSeeds(1, "figure1-seeds-paper", mesh, paper.seed(), seedCaption("paper", paper));
  pictures.drawSeeds(1, "figure1-seeds-balanced", mesh, balanced.seed(), seedCaption("balanced", balanced));
  draw(1, "figure1-sdf-paper", paper, errorCaption("paper", evaluation, paper));
  draw(1, "figure1-sdf-balanced", balanced, errorCaption("balanced", evaluation, balanced));
  drawLaplacian(pictures, mesh, evaluation);
  const Result sparsePaper = compute(Recipe::Paper, kSparsePercent);
  const Result sparseBalanced = compute(Recipe::Balanced, kSparsePercent);
  draw(3, "figure3-paper", sparsePaper, errorCaption("paper", evaluation, sparsePaper));
  draw(3, "figure3-balanced", sparseBalanced, errorCaption("balanced", evaluation, sparseBalanced));
  draw(3, "figure3-full", evaluation.full, "all faces");
  draw(4, "figure4-full", evaluation.full, "all faces");
  draw(4, "figure4-paper", paper, "paper");
  draw(4, "figure4-balanced", balanced, "balanced");
  drawErrors(pictures, mesh, evaluation, paper, balanced);
}

CsvTable drawSamplers(PictureWriter& pictures, FigurePages& pages, Session& session, NamedMesh& mesh,
                      const Evaluation& evaluation, uint32_t seedSetCount, const RunControl& control) {
  CsvTable table{{"sampler", "seeds", "paper_average_error", "balanced_average_error"}, {}};
  for (const auto& [sampler, choice] : kSamplerNames) {
    std::vector<double> paper, balanced;
    Result first;
    for (uint32_t round = 1; round <= seedSetCount; ++round) {
      const auto compute = [&, choice = choice](Recipe recipe, std::vector<double>& errors) {
        Result result = session.compute(mesh.mesh, samplerOptions(choice, recipe, round), control);
        errors.push_back(errorsOverRange(evaluation.full.sdf(), result.sdf()).average);
        return result;
      };
      Result result = compute(Recipe::Balanced, balanced);
      static_cast<void>(compute(Recipe::Paper, paper));
      if (round == 1) first = std::move(result);
    }
    const double paperError = dispersionOf(paper).median, balancedError = dispersionOf(balanced).median;
    table.rows.push_back(
        {sampler, std::to_string(first.report.seedCount), csvNumber(paperError), csvNumber(balancedError)});
    pictures.drawSeeds(
        7, fmt::format("figure7-{}", sampler), mesh, first.seed(),
        fmt::format("{}: average error {:.4f} (paper), {:.4f} (balanced)", sampler, paperError, balancedError));
    pages.add(7, mesh, first, sampler);
  }
  return table;
}

void drawAllMeshes(PictureWriter& pictures, FigurePages& pages, Session& session, std::vector<NamedMesh>& meshes,
                   const RunControl& control) {
  for (NamedMesh& mesh : meshes) {
    const Result result = session.compute(mesh.mesh, recipeOptions(Recipe::Balanced, kFigurePercent), control);
    pictures.drawField(8, "figure8-" + mesh.name, mesh, result.sdf(), {kSdfTitle, percentileRange(result.sdf())},
                       fmt::format("{}: {} faces, {} seeds", mesh.name, groupDigits(result.report.faceCount),
                                   groupDigits(result.report.seedCount)));
    pages.add(8, mesh, result, mesh.name);
  }
}

}  // namespace asdfvk::bench
