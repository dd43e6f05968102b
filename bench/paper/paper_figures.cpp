#include "paper/paper_figures.h"
#include "core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/report_text.h"
#include "paper/laplacian.h"
#include "paper/paper_numbers.h"
#include "paper/triangle_values.h"
#include "share_errors.h"

namespace asdfvk::bench {
namespace {

constexpr const char* kSdfTitle = "SDF";
constexpr double kLaplacianPercentile = 0.99, kErrorPercentile = 0.98;

/// What the figures of one mesh have in common.
struct Scene {
  const Studio& studio;
  const Subject& subject;
  const Evaluation& evaluation;
  Result paperTenth, balancedTenth, paperSparse, balancedSparse;
  FieldStyle sdfStyle;

  [[nodiscard]] PageImage sdf(const std::string& file, const std::vector<double>& values,
                              const std::string& caption) const {
    return studio.field(file, subject, values, sdfStyle, caption);
  }
  [[nodiscard]] std::string errorsOf(const Result& result) const {
    const ShareErrors errors = errorsOverRange(evaluation.full.sdf, result.sdf);
    return fmt::format("average error {:.4f}, max {:.3f}", errors.average, errors.maximum);
  }
};

std::vector<double> errorMap(const Evaluation& evaluation, const Result& result) {
  std::vector<double> errors(result.sdf.size());
  for (size_t i = 0; i < errors.size(); ++i)
    errors[i] = std::abs(result.sdf[i] - evaluation.full.sdf[i]) / evaluation.range();
  return errors;
}

void addTeaser(Page& page, const Scene& scene) {
  const auto seedsCaption = [](const char* recipe, const Result& result) {
    return fmt::format("{}: {} seeds", recipe, groupDigits(result.report.seedCount));
  };
  page.figure(
      {scene.studio.seeds("figure1-seeds-paper", scene.subject, scene.paperTenth.isSeed,
                          seedsCaption("paper", scene.paperTenth), kWithBar),
       scene.studio.seeds("figure1-seeds-balanced", scene.subject, scene.balancedTenth.isSeed,
                          seedsCaption("balanced", scene.balancedTenth), kWithBar),
       scene.sdf("figure1-sdf-paper", scene.paperTenth.sdf, "paper: " + scene.errorsOf(scene.paperTenth)),
       scene.sdf("figure1-sdf-balanced", scene.balancedTenth.sdf, "balanced: " + scene.errorsOf(scene.balancedTenth))},
      2, "Figure 1",
      fmt::format("The function is computed only on the selected faces, {:g} % of all (red, top). The "
                  "constrained interpolation gives the other values (bottom). Left as the paper has it, with "
                  "faces chosen at random; right the balanced recipe.",
                  kTeaserPercent));
}

void addLaplacian(Page& page, const Scene& scene) {
  const std::vector<double> ofTriangles =
      absoluteLaplacian(scene.subject.mesh, onTriangles(scene.subject.mesh, scene.evaluation.full.sdf));
  const std::vector<double> shown = overPercentile(ofTriangles, kLaplacianPercentile);
  const auto low = std::count_if(shown.begin(), shown.end(), [](double v) { return v < 0.1; });
  const auto present = std::count_if(shown.begin(), shown.end(), [](double v) { return !std::isnan(v); });
  const Mesh& mesh = scene.subject.mesh;
  const Subject triangles{scene.subject.name, {mesh.vertices, mesh.faces, {}}, scene.subject.view};
  page.figure(
      {scene.studio.field("figure2-laplacian", triangles, shown, {"|Laplacian|", {0, 1}}, "")}, 1, "Figure 2",
      fmt::format(
          "The absolute difference between each face\u2019s value and its neighbourhood\u2019s, |\u03a3 w SDF(p) "
          "\u2212 \u03a3 w SDF(v)| with w = 1 / distance of the barycentres, of the full function, over "
          "its 99th percentile. It is below a tenth of that on {:.0f} % of the faces: the function "
          "varies little on most of the surface, and most where the shape changes sharply.",
          100.0 * static_cast<double>(low) / static_cast<double>(std::max<std::ptrdiff_t>(1, present))));
}

void addSparse(Page& page, const Scene& scene) {
  const std::string percent = fmt::format("{:g} %", kSparsePercent);
  page.figure({scene.sdf("figure3-paper", scene.paperSparse.sdf,
                         "paper, " + percent + ": " + scene.errorsOf(scene.paperSparse)),
               scene.sdf("figure3-balanced", scene.balancedSparse.sdf,
                         "balanced, " + percent + ": " + scene.errorsOf(scene.balancedSparse)),
               scene.sdf("figure3-full", scene.evaluation.full.sdf, "100 %")},
              3, "Figure 3",
              fmt::format("The function from {} of the faces (left and middle) and from all of them (right), one "
                          "colour scale. The paper prints an average error of {:.4f} at {} for its horse.",
                          percent, kPrintedErrors[3].average, percent));
}

void addErrorMaps(Page& page, const Scene& scene) {
  const Evaluation& evaluation = scene.evaluation;
  const std::vector<double> paper = errorMap(evaluation, scene.paperTenth);
  const std::vector<double> balanced = errorMap(evaluation, scene.balancedTenth);
  std::vector<double> expected = scene.balancedTenth.expectedError;
  for (double& error : expected) error /= evaluation.range();
  std::vector<double> sorted = paper;
  sorted.erase(std::remove_if(sorted.begin(), sorted.end(), [](double v) { return std::isnan(v); }), sorted.end());
  std::sort(sorted.begin(), sorted.end());
  const double top = sorted[static_cast<size_t>(kErrorPercentile * static_cast<double>(sorted.size() - 1))];
  const FieldStyle errorStyle{"|error| / range", {0, top}};
  const auto map = [&](const char* file, const std::vector<double>& values, const std::string& caption) {
    return scene.studio.field(file, scene.subject, values, errorStyle, caption);
  };
  std::vector<PageImage> images{scene.sdf("figure4-full", evaluation.full.sdf, "all faces"),
                                scene.sdf("figure4-paper", scene.paperTenth.sdf, "paper, 10 % of the faces"),
                                scene.sdf("figure4-balanced", scene.balancedTenth.sdf, "balanced, 10 % of the faces")};
  if (!expected.empty())
    images.push_back(map("figure4-expected", expected,
                         fmt::format("error that balanced itself expects, average {:.4f}",
                                     scene.balancedTenth.report.estimatedError->average)));
  images.push_back(map("figure4-error-paper", paper, "paper: " + scene.errorsOf(scene.paperTenth)));
  images.push_back(map("figure4-error-balanced", balanced, "balanced: " + scene.errorsOf(scene.balancedTenth)));
  page.figure(
      images, 3, "Figure 4",
      fmt::format("Top: the function computed on all the faces, and from 10 % of them. Below: the differences "
                  "to the function on all the faces over its range, and what the balanced recipe expects of "
                  "them without having computed it. The colours end at the 98th percentile of the paper "
                  "recipe\u2019s differences; the largest lie along the boundaries of the parts. The paper prints "
                  "an average error of {:.4f} and a maximum of {:.4f} for its horse.",
                  kPrintedErrors[2].average, kPrintedErrors[2].maximum));
}

}  // namespace

void addPaperFigures(Page& page, const Studio& studio, Session& session, Subject& subject, const Evaluation& evaluation,
                     const RunControl& control) {
  const auto compute = [&](Recipe recipe, double percent) {
    return session.compute(subject.mesh, recipeOptions(recipe, percent, 1), control);
  };
  const Scene scene{.studio = studio,
                    .subject = subject,
                    .evaluation = evaluation,
                    .paperTenth = compute(Recipe::Paper, kTeaserPercent),
                    .balancedTenth = compute(Recipe::Balanced, kTeaserPercent),
                    .paperSparse = compute(Recipe::Paper, kSparsePercent),
                    .balancedSparse = compute(Recipe::Balanced, kSparsePercent),
                    .sdfStyle = {kSdfTitle, percentileRange(evaluation.full.sdf)}};
  addTeaser(page, scene);
  addLaplacian(page, scene);
  addSparse(page, scene);
  addErrorMaps(page, scene);
}

}  // namespace asdfvk::bench
