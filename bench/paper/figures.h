#pragma once

#include "paper/evaluation.h"
#include "paper/figure_pages.h"
#include "paper/pictures.h"

namespace asdfvk::bench {

// Shares of the faces in the figures of the ASDF paper, in percent.

/// Share for Figures 1, 4 and 8. The paper states this share for Figure 4.
inline constexpr double kFigurePercent = 10;
inline constexpr double kSparsePercent = 5;   ///< Share for Figure 3.
inline constexpr double kSamplerPercent = 7;  ///< Share for Figure 7.

/// Figures 1 (seeds and result), 2 (Laplacian), 3 (5 % and all faces) and 4 (errors).
void drawMeshFigures(PictureWriter& pictures, FigurePages& pages, Session& session, NamedMesh& mesh,
                     const Evaluation& evaluation, const RunControl& control);

/// Figure 7: the seeds of every sampler. Returns the columns sampler, seeds, paper_average_error and
/// balanced_average_error. An error is the error of the interpolation with a recipe, as median over the seed sets.
[[nodiscard]] CsvTable drawSamplers(PictureWriter& pictures, FigurePages& pages, Session& session, NamedMesh& mesh,
                                    const Evaluation& evaluation, uint32_t seedSetCount, const RunControl& control);

/// Figure 8: the result of every mesh with the recipe balanced.
void drawAllMeshes(PictureWriter& pictures, FigurePages& pages, Session& session, std::vector<NamedMesh>& meshes,
                   const RunControl& control);

}  // namespace asdfvk::bench
