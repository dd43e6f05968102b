#pragma once

#include "paper/evaluation.h"
#include "paper/plots/table.h"

namespace asdfvk::bench {

/// Table 1: errors of every recipe at every share against the full function, beside the paper's printed ones where
/// `withPrinted` says so, and against the truth.
[[nodiscard]] Table errorTable(const Evaluation& evaluation, bool withPrinted);

/// Each recipe's errors at 10 % for all meshes, a line per mesh, over the paper recipe's.
[[nodiscard]] Table summaryTable(const std::vector<Evaluation>& evaluations);

/// Figures 5 and 6 as numbers: a line per mesh, recipe and share.
[[nodiscard]] Table measurementTable(const std::vector<Evaluation>& evaluations);

}  // namespace asdfvk::bench
