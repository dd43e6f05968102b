#pragma once

#include <string>
#include <vector>

#include "paper/evaluation.h"
#include "paper/output.h"

namespace asdfvk::bench {

// The CSV files of asdfvk-bench-paper, which plot_paper.py reads. A cell without a value is empty. Errors are divided
// by the range of the full function. Times are in seconds.
//
// run.csv       name, value: version, device, options.
// meshes.csv    mesh, faces, sdf_min, sdf_max, full_trace_seconds: the full function.
// table1.csv    mesh, recipe, percent, seeds, average_error, least_average_error, greatest_average_error (over the
//               random seeds), maximum_error (against the full function),
//               truth_average_error, truth_maximum_error (against the truth), estimated_error: Table 1 and Figure 5.
// figure6.csv   mesh, recipe, percent, seeds, sample_seconds, trace_seconds, predict_seconds, solve_seconds, time_ratio
//               (sum of the seconds / seconds of the full trace).
// figure7.csv   sampler, seeds, paper_average_error, balanced_average_error: by the recipe of the interpolation.
// pictures.csv  figure, file, caption: the PNG files in the order of the page.

[[nodiscard]] CsvTable meshTable(const std::vector<Evaluation>& evaluations);
[[nodiscard]] CsvTable errorTable(const std::vector<Evaluation>& evaluations);
[[nodiscard]] CsvTable timeTable(const std::vector<Evaluation>& evaluations);

}  // namespace asdfvk::bench
