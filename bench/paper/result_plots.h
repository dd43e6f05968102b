#pragma once

#include <vector>

#include "paper/evaluation.h"
#include "paper/plots/line_plot.h"

namespace asdfvk::bench {

/// Of one mesh: Table 1 as curves, with the printed ones where `withPrinted` says so.
[[nodiscard]] LinePlot tablePlot(const Evaluation& evaluation, bool withPrinted);
/// The same against the truth, with the noise floor.
[[nodiscard]] LinePlot truthPlot(const Evaluation& evaluation, uint32_t truthRayCount);

/// Figure 5: average error over the percentage, a line per mesh. The same axes for every recipe.
[[nodiscard]] LinePlot errorPlot(const std::vector<Evaluation>& evaluations, Recipe recipe);
/// Figure 5 as the paper colours it: meshes side by side, green 10 %, red 20 %, blue 50 % of the faces.
[[nodiscard]] LinePlot meshPlot(const std::vector<Evaluation>& evaluations, Recipe recipe);

/// Figure 6: seconds over the number of selected faces, the recipes of one mesh.
[[nodiscard]] LinePlot secondsPlot(const Evaluation& evaluation);
/// Figure 6: time over the percentage as a share of the full trace's, the recipes of one mesh.
[[nodiscard]] LinePlot timePlot(const Evaluation& evaluation);

}  // namespace asdfvk::bench
