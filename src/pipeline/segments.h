#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"
#include "pipeline/prepared_mesh.h"
#include "segment/parts.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// Results of Options::postprocess and Options::segmentation. Empty where they were not requested.
struct SegmentedValues {
  std::vector<double> normalized;  ///< #F
  std::vector<uint32_t> segments;  ///< #I, see segmentsOfInputFaces().
  /// #I, Segmentation::Parts only: see SegmentBoundaries::stability.
  std::vector<double> boundaryStability;
};

/// Post-processes the values of the triangles (#F, NaN for no value), segments the mesh by them, and adds the results
/// to the report. sight: for Segmentation::Parts only. Scaling the mesh by a power of two changes no bit. The result
/// has the same bits on any number of threads. Throws Error{NoValues}, and Error{TooFewValues} where there are fewer
/// different values than clusters.
[[nodiscard]] SegmentedValues segmentValues(const PreparedMesh& prepared, std::span<const double> values,
                                            const Options& options, const LineOfSight& sight, StageClock& clock,
                                            Report& report, const RunControl& control);

/// Tests lines of sight in the scene by the tracer of the CPU, or by the reference. The first call of the result makes
/// the tracer. The scene and the nodes of its hierarchy must outlive the result.
[[nodiscard]] LineOfSight makeLineOfSight(const TraceScene& scene, bool usesReference, const RunControl& control);

}  // namespace asdfvk
