#include "paper/error_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/paper_numbers.h"

namespace asdfvk::bench {
namespace {

constexpr int kErrorDecimals = 4;

Cell percentCell(double percent) { return {fmt::format("{:g} %", percent), fmt::format("{:g}", percent), true}; }

Cell errorCell(double error) { return Cell::number(error, kErrorDecimals); }

const PrintedErrors* printedAt(double percent) {
  const auto found = std::find_if(kPrintedErrors.begin(), kPrintedErrors.end(),
                                  [&](const PrintedErrors& printed) { return printed.percent == percent; });
  return found == kPrintedErrors.end() ? nullptr : &*found;
}

void addRecipeColumns(Table& table, const std::string& group) {
  for (const auto& [name, recipe] : kRecipes) table.columns.push_back({group, name});
}

}  // namespace

Table errorTable(const Evaluation& evaluation, bool withPrinted) {
  const std::string average = "average error", maximum = "maximum error", truth = "average error against the truth";
  Table table;
  table.columns.push_back({"", "faces"});
  if (withPrinted) table.columns.push_back({average, "printed", true});
  addRecipeColumns(table, average);
  table.columns.push_back({average, "estimated"});
  if (withPrinted) table.columns.push_back({maximum, "printed", true});
  addRecipeColumns(table, maximum);
  addRecipeColumns(table, truth);
  for (size_t i = 0; i < kPercents.size(); ++i) {
    const PrintedErrors* printed = printedAt(kPercents[i]);
    std::vector<Cell> row{percentCell(kPercents[i])};
    const auto addRecipes = [&](double ShareResult::*field) {
      for (const auto& recipe : evaluation.recipes) row.push_back(errorCell(recipe[i].*field));
    };
    if (withPrinted) row.push_back(errorCell(printed ? printed->average : kNoValue));
    addRecipes(&ShareResult::average);
    row.push_back(errorCell(evaluation.at(Recipe::Balanced, kPercents[i]).estimated));
    if (withPrinted) row.push_back(errorCell(printed ? printed->maximum : kNoValue));
    addRecipes(&ShareResult::maximum);
    addRecipes(&ShareResult::truthAverage);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table summaryTable(const std::vector<Evaluation>& evaluations) {
  const std::string full = "against the full function", truth = "against the truth", ratio = "balanced / paper";
  Table table;
  table.columns = {{"", "mesh"}, {"", "faces"}};
  addRecipeColumns(table, full);
  addRecipeColumns(table, truth);
  table.columns.push_back({truth, "full function"});
  table.columns.push_back({ratio, "full"});
  table.columns.push_back({ratio, "truth"});
  double logFull = 0, logTruth = 0;
  for (const Evaluation& evaluation : evaluations) {
    std::vector<Cell> row{Cell::word(evaluation.name), Cell::count(evaluation.full.report.faceCount)};
    for (const auto& [name, recipe] : kRecipes) row.push_back(errorCell(evaluation.at(recipe, 10).average));
    for (const auto& [name, recipe] : kRecipes) row.push_back(errorCell(evaluation.at(recipe, 10).truthAverage));
    row.push_back(errorCell(evaluation.floor().truthAverage));
    const ShareResult &paper = evaluation.at(Recipe::Paper, 10), &balanced = evaluation.at(Recipe::Balanced, 10);
    row.push_back(Cell::number(balanced.average / paper.average, 2));
    row.push_back(Cell::number(balanced.truthAverage / paper.truthAverage, 2));
    logFull += std::log(balanced.average / paper.average);
    logTruth += std::log(balanced.truthAverage / paper.truthAverage);
    table.rows.push_back(std::move(row));
  }
  if (evaluations.size() > 1) {
    const double count = static_cast<double>(evaluations.size());
    std::vector<Cell> row(table.columns.size(), Cell::number(kNoValue, 0));
    row[0] = Cell::word("geometric mean");
    row[row.size() - 2] = Cell::number(std::exp(logFull / count), 2);
    row[row.size() - 1] = Cell::number(std::exp(logTruth / count), 2);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table measurementTable(const std::vector<Evaluation>& evaluations) {
  Table table;
  for (const char* name :
       {"mesh", "faces", "recipe", "percent", "seeds", "average error", "maximum error",
        "average error against the truth", "maximum error against the truth", "estimated error", "sample seconds",
        "trace seconds", "predict seconds", "solve seconds", "seconds over those of the full trace"})
    table.columns.push_back({"", name});
  for (const Evaluation& evaluation : evaluations)
    for (size_t recipe = 0; recipe < kRecipeCount; ++recipe)
      for (const ShareResult& share : evaluation.recipes[recipe]) {
        std::vector<Cell> row{Cell::word(evaluation.name), Cell::count(evaluation.full.report.faceCount),
                              Cell::word(kRecipes[recipe].first), percentCell(share.percent),
                              Cell::count(share.seedCount)};
        for (const double value :
             {share.average, share.maximum, share.truthAverage, share.truthMaximum, share.estimated,
              share.sampleSeconds, share.traceSeconds, share.predictSeconds, share.solveSeconds, share.timeRatio})
          row.push_back(errorCell(value));
        table.rows.push_back(std::move(row));
      }
  return table;
}

}  // namespace asdfvk::bench
