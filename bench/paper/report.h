#pragma once

#include <string>
#include <vector>

#include "paper/evaluation.h"
#include "paper/output_folder.h"
#include "paper/page.h"

namespace asdfvk::bench {

/// Table 1 of every mesh with its curves. The first mesh stands beside the paper's printed numbers.
void addTables(Page& page, const OutputFolder& folder, const std::vector<Evaluation>& evaluations,
               const EvaluationOptions& options);

/// Figures 5 and 6, and all measurements as CSV.
void addPlots(Page& page, const OutputFolder& folder, const std::vector<Evaluation>& evaluations);

}  // namespace asdfvk::bench
