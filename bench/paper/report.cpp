#include "paper/report.h"
#include "core/text.h"

#include <fmt/format.h>

#include "cli/report_text.h"
#include "paper/error_table.h"
#include "paper/paper_numbers.h"
#include "paper/result_plots.h"

namespace asdfvk::bench {
namespace {

constexpr const char* kMeasurements = "measurements.csv";

PageImage plotImage(const OutputFolder& folder, const std::string& name, const LinePlot& plot) {
  folder.write(name + ".svg", toSvg(plot));
  return {name + ".svg", ""};
}

std::string tableCaption(const Evaluation& evaluation, bool isFirst) {
  const Report& report = evaluation.full.report;
  return fmt::format(
      "{}, {} faces: errors over the range of the full function ({:.4g} to {:.4g}), all faces "
      "counted.{}",
      evaluation.name, groupDigits(report.faceCount), report.sdf.min, report.sdf.max,
      isFirst ? " \u201cPrinted\u201d are the paper\u2019s numbers for its horse." : "");
}

}  // namespace

void addTables(Page& page, const OutputFolder& folder, const std::vector<Evaluation>& evaluations,
               const EvaluationOptions& options) {
  page.heading("Table 1: error by the percentage of faces");
  page.paragraph(fmt::format(
      "The full function casts 30 rays at every face, all cones turned alike: the paper\u2019s reference. The truth "
      "casts {} rays at every face, each cone turned by a hash. The row at 100 % against the truth is the noise floor: "
      "what the full function itself is off by. Every number is the median over {} random seed set{}. "
      "\u201cEstimated\u201d is what a result of "
      "the balanced recipe tells of its own average error, from some faces held out and without the full function. A "
      "maximum above 1 is a value outside of the full function\u2019s range.",
      options.truthRayCount, options.seedSetCount, options.seedSetCount == 1 ? "" : "s"));
  page.paragraph(
      "Recipe paper: random seeds, weights 1 / distance. Balanced: seeds as blue noise, weights by dihedral angle, "
      "guided by what the rays of neighbouring seeds hit. Quality: the same with cones turned by a hash and values "
      "pooled over neighbouring cones, traced ones too; it aims at the truth and so differs from the full function "
      "even where all faces are traced.");
  bool isFirst = true;
  for (const Evaluation& evaluation : evaluations) {
    const std::string csv = "table1-" + evaluation.name + ".csv";
    const Table table = errorTable(evaluation, isFirst);
    folder.write(csv, toCsv(table));
    page.table(table, tableCaption(evaluation, isFirst), csv);
    if (isFirst)
      page.figure(
          {plotImage(folder, "table1-" + evaluation.name, tablePlot(evaluation, true)),
           plotImage(folder, "table1-" + evaluation.name + "-truth", truthPlot(evaluation, options.truthRayCount))},
          2, "",
          "The table as curves. Left, seeds count as free of error; right they do not, as their 30 rays are "
          "off like all others\u2019.");
    isFirst = false;
  }
  page.heading("All meshes at 10 % of the faces");
  const Table summary = summaryTable(evaluations);
  folder.write("summary.csv", toCsv(summary));
  page.table(summary, "Average errors over the range of the full function.", "summary.csv");
}

void addPlots(Page& page, const OutputFolder& folder, const std::vector<Evaluation>& evaluations) {
  folder.write(kMeasurements, toCsv(measurementTable(evaluations)));
  page.heading("Figure 5: error over the percentage of faces");
  std::vector<PageImage> images;
  for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced})
    images.push_back(
        plotImage(folder, fmt::format("figure5-{}", nameOf(kRecipes, recipe)), errorPlot(evaluations, recipe)));
  std::string caption =
      "Average error against the full function in function of the percentage of faces used, left as the paper has it, "
      "right the balanced recipe, on the same axes.";
  if (evaluations.size() > 1) {
    for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced})
      images.push_back(plotImage(folder, fmt::format("figure5-{}-by-mesh", nameOf(kRecipes, recipe)),
                                 meshPlot(evaluations, recipe)));
    caption +=
        " Below, mesh by mesh in the paper\u2019s colours: green when selecting 10 % of the faces, red 20 % and blue "
        "50 %.";
  }
  page.figure(images, 2, "Figure 5", caption, kMeasurements);

  page.heading("Figure 6: time over the percentage of faces");
  const Evaluation& first = evaluations.front();
  const ShareResult &paper = first.at(Recipe::Paper, 10), &balanced = first.at(Recipe::Balanced, 10);
  page.figure(
      {plotImage(folder, "figure6-" + first.name, secondsPlot(first)),
       plotImage(folder, "figure6-" + first.name + "-ratio", timePlot(first))},
      2, "Figure 6",
      fmt::format("Left, time in function of the number of selected faces, {}: choosing the seeds, tracing "
                  "them, predicting from their hits and solving. Right, the same over the trace of all faces "
                  "in the same round ({:.3g} s). At 10 %, {} faces, it is {:.3f} of that with recipe paper and "
                  "{:.3f} with balanced; the paper tells of {:g} s that become slightly more than {:g}, a "
                  "ratio of {:.2g}. Times depend on the machine and on what else it does.",
                  first.name, first.fullTraceSeconds, groupDigits(paper.seedCount), paper.timeRatio, balanced.timeRatio,
                  kPrintedFullSeconds, kPrintedTenthSeconds, kPrintedTenthSeconds / kPrintedFullSeconds),
      kMeasurements);
}

}  // namespace asdfvk::bench
