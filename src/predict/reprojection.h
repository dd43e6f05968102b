#pragma once

#include <vector>

#include "predict/seed_cells.h"
#include "predict/traced_cones.h"

/// What the traced rays of the seeds around a face tell about the face itself, which cast none. The points that they
/// met lie on the other side of the shape, and most of them can be seen from the face too: seen from there, each gives
/// a length and an angle to the face's own axis. Those within its cone, weighed by the solid angle that they stand for
/// there, are put through the shape diameter's own rules. No ray is cast; what stands between the face and a point is
/// not looked for.
///
/// It is the reprojection of cached rays known from global illumination (Ward and Heckbert 1992, "Irradiance
/// gradients"; Bekaert, Sbert and Halton 2002, "Accelerating path tracing by re-using paths"), applied to the
/// ASDF paper's problem: its gradient is the guidance field that the paper's section 4.1 asks for and fills with the
/// curvature.
namespace asdfvk {

struct ReprojectionOptions {
  uint32_t neighbourCount = 6;  ///< Cells around a face's own whose seeds are asked.
  /// How far a seed's word carries: at this many times half the mean distance to the neighbouring seeds it weighs
  /// exp(-1/2).
  double reach = 1.5;
};

/// The predicted shape diameter of each face, and what it was made of.
struct Prediction {
  /// #F, seeds included, in the mesh's unit; kNoValue where a face is degenerate, no seed is near, or no point lies in
  /// its cone.
  std::vector<double> values;
  std::vector<uint32_t> cellOf;  ///< #F, as SeedCells::cellOf.
  NearestCells nearest;          ///< Whom each cell asked.
};

/// The same for any number of threads. earlier: of the same scene, cone and options, from seeds that have kept their
/// places in `traced` if they are still there, or empty; what has not changed is taken from it.
[[nodiscard]] Prediction reprojectHits(const TraceScene& scene, const DualGraph& graph, const Cone& cone,
                                       const TracedCones& traced, const ReprojectionOptions& options,
                                       Prediction earlier = {});

}  // namespace asdfvk
