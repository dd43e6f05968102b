#include "paper/tables.h"

namespace asdfvk::bench {
namespace {

/// A table with a row per mesh, recipe and share of seeds. The columns are mesh, recipe, percent, seeds, and the given
/// numbers.
CsvTable shareTable(const std::vector<Evaluation>& evaluations,
                    const std::vector<std::pair<const char*, double ShareResult::*>>& numbers) {
  CsvTable table{{"mesh", "recipe", "percent", "seeds"}, {}};
  for (const auto& [name, field] : numbers) table.columns.emplace_back(name);
  for (const Evaluation& evaluation : evaluations)
    for (size_t recipe = 0; recipe < kRecipes.size(); ++recipe)
      for (const ShareResult& share : evaluation.recipes[recipe]) {
        std::vector<std::string> row{evaluation.name, kRecipes[recipe].first, csvNumber(share.percent),
                                     std::to_string(share.seedCount)};
        for (const auto& [name, field] : numbers) row.push_back(csvNumber(share.*field));
        table.rows.push_back(std::move(row));
      }
  return table;
}

}  // namespace

CsvTable meshTable(const std::vector<Evaluation>& evaluations) {
  CsvTable table{{"mesh", "faces", "sdf_min", "sdf_max", "full_trace_seconds"}, {}};
  for (const Evaluation& evaluation : evaluations) {
    const Report& report = evaluation.full.report;
    table.rows.push_back({evaluation.name, std::to_string(report.faceCount), csvNumber(report.sdf.min),
                          csvNumber(report.sdf.max), csvNumber(evaluation.fullTraceSeconds)});
  }
  return table;
}

CsvTable errorTable(const std::vector<Evaluation>& evaluations) {
  return shareTable(evaluations, {{"average_error", &ShareResult::averageError},
                                  {"least_average_error", &ShareResult::leastAverageError},
                                  {"greatest_average_error", &ShareResult::greatestAverageError},
                                  {"maximum_error", &ShareResult::maximumError},
                                  {"truth_average_error", &ShareResult::truthAverageError},
                                  {"truth_maximum_error", &ShareResult::truthMaximumError},
                                  {"estimated_error", &ShareResult::estimatedError}});
}

CsvTable timeTable(const std::vector<Evaluation>& evaluations) {
  return shareTable(evaluations, {{"sample_seconds", &ShareResult::sampleSeconds},
                                  {"trace_seconds", &ShareResult::traceSeconds},
                                  {"predict_seconds", &ShareResult::predictSeconds},
                                  {"solve_seconds", &ShareResult::solveSeconds},
                                  {"time_ratio", &ShareResult::timeRatio}});
}

}  // namespace asdfvk::bench
