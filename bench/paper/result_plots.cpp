#include "paper/result_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "paper/paper_numbers.h"

namespace asdfvk::bench {
namespace {

constexpr std::array<const char*, kRecipeCount> kRecipeColours{kVermilion, kBlue, kGreen};
constexpr const char* kShareLabel = "faces that cast rays, %";
constexpr const char* kErrorLabel = "average error / range";

Axis shareAxis(double high) { return {kShareLabel, 1, high, true, {}}; }

Series recipeSeries(const Evaluation& evaluation, size_t recipe, double ShareResult::*field) {
  Series series{kRecipes[recipe].first, {}, kRecipeColours[recipe], recipe};
  for (auto share = evaluation.recipes[recipe].rbegin(); share != evaluation.recipes[recipe].rend(); ++share)
    series.points.push_back({share->percent, (*share).*field});
  return series;
}

/// Removes the point at all faces, where the paper's error is 0 by definition.
Series withoutAll(Series series) {
  series.points.pop_back();
  return series;
}

std::vector<double> valuesOf(const std::vector<Series>& series) {
  std::vector<double> values;
  for (const Series& one : series)
    for (const PlotPoint& point : one.points) values.push_back(point.y);
  return values;
}

/// Holds the errors of all recipes, so that their plots can be compared.
Axis commonErrorAxis(const std::vector<Evaluation>& evaluations) {
  std::vector<double> values;
  for (const Evaluation& evaluation : evaluations)
    for (const auto& recipe : evaluation.recipes)
      for (const ShareResult& share : recipe)
        if (share.percent < 100) values.push_back(share.average);
  return logarithmicAxis(kErrorLabel, values);
}

}  // namespace

LinePlot tablePlot(const Evaluation& evaluation, bool withPrinted) {
  LinePlot plot{.title = evaluation.name + ", against the full function", .x = shareAxis(50), .y = {}, .series = {}};
  if (withPrinted) {
    Series printed{"printed", {}, kBlack, 4, true};
    for (auto row = kPrintedErrors.rbegin(); row != kPrintedErrors.rend(); ++row)
      printed.points.push_back({row->percent, row->average});
    plot.series.push_back(std::move(printed));
  }
  for (size_t recipe = 0; recipe < kRecipeCount; ++recipe)
    plot.series.push_back(withoutAll(recipeSeries(evaluation, recipe, &ShareResult::average)));
  plot.y = logarithmicAxis(kErrorLabel, valuesOf(plot.series));
  return plot;
}

LinePlot truthPlot(const Evaluation& evaluation, uint32_t truthRayCount) {
  LinePlot plot{.title = fmt::format("{}, against {} rays at every face", evaluation.name, truthRayCount),
                .x = shareAxis(100),
                .y = {},
                .series = {}};
  for (size_t recipe = 0; recipe < kRecipeCount; ++recipe)
    plot.series.push_back(recipeSeries(evaluation, recipe, &ShareResult::truthAverage));
  const double floor = evaluation.floor().truthAverage;
  plot.series.push_back({"full function", {{1, floor}, {100, floor}}, kBlack, 0, true, false});
  plot.y = logarithmicAxis(kErrorLabel, valuesOf(plot.series));
  return plot;
}

LinePlot errorPlot(const std::vector<Evaluation>& evaluations, Recipe recipe) {
  LinePlot plot{.title = nameOf(kRecipes, recipe), .x = shareAxis(50), .y = commonErrorAxis(evaluations), .series = {}};
  for (size_t i = 0; i < evaluations.size(); ++i) {
    Series series = withoutAll(recipeSeries(evaluations[i], static_cast<size_t>(recipe), &ShareResult::average));
    series.name = evaluations[i].name;
    series.colour = seriesColour(i);
    series.marker = i;
    plot.series.push_back(std::move(series));
  }
  return plot;
}

LinePlot meshPlot(const std::vector<Evaluation>& evaluations, Recipe recipe) {
  struct Line {
    double percent;
    const char* colour;
  };
  const double last = static_cast<double>(evaluations.size()) - 1;
  LinePlot plot{
      .title = nameOf(kRecipes, recipe), .x = {"", -0.3, last + 0.3}, .y = commonErrorAxis(evaluations), .series = {}};
  for (size_t i = 0; i < evaluations.size(); ++i) plot.x.ticks.push_back({static_cast<double>(i), evaluations[i].name});
  size_t marker = 0;
  for (const Line& line : {Line{10, kGreen}, Line{20, kVermilion}, Line{50, kBlue}}) {
    Series series{fmt::format("{:g} %", line.percent), {}, line.colour, marker++};
    for (size_t i = 0; i < evaluations.size(); ++i)
      series.points.push_back({static_cast<double>(i), evaluations[i].at(recipe, line.percent).average});
    plot.series.push_back(std::move(series));
  }
  return plot;
}

LinePlot secondsPlot(const Evaluation& evaluation) {
  LinePlot plot{.title = evaluation.name + ", seconds", .x = {"faces that cast rays"}, .y = {"seconds"}, .series = {}};
  double most = 0;
  for (size_t recipe = 0; recipe < kRecipeCount; ++recipe) {
    Series series{kRecipes[recipe].first, {}, kRecipeColours[recipe], recipe};
    for (const ShareResult& share : evaluation.recipes[recipe]) {
      series.points.insert(series.points.begin(), {static_cast<double>(share.seedCount), share.seconds()});
      most = std::max(most, share.seconds());
      plot.x.high = std::max(plot.x.high, static_cast<double>(share.seedCount));
    }
    plot.series.push_back(std::move(series));
  }
  plot.y.high = most * 1.05;
  return plot;
}

LinePlot timePlot(const Evaluation& evaluation) {
  LinePlot plot{
      .title = evaluation.name + ", time over that of the full trace", .x = shareAxis(100), .y = {}, .series = {}};
  for (size_t recipe = 0; recipe < kRecipeCount; ++recipe)
    plot.series.push_back(recipeSeries(evaluation, recipe, &ShareResult::timeRatio));
  plot.series.push_back({"in proportion", {{1, 0.01}, {100, 1}}, kBlack, 0, true, false});
  plot.y = logarithmicAxis("choosing, tracing, predicting, solving / full trace", valuesOf(plot.series));
  return plot;
}

}  // namespace asdfvk::bench
