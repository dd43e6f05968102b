#include "pipeline/segments.h"

#include <algorithm>
#include <utility>

#include "pipeline/result.h"
#include "segment/cgal_postprocess.h"
#include "segment/cgal_segmentation.h"

namespace asdfvk {
namespace {

/// In a unit in which no square overflows or underflows.
CgalValues postprocess(const PreparedMesh& prepared, const FaceNeighbours& neighbours, std::span<const double> values) {
  const Normalization unit = normalizationOf(prepared.geometry.bounds);
  std::vector<double> scaled(values.begin(), values.end());
  for (double& value : scaled) value *= unit.scale;
  CgalValues result = postprocessLikeCgal(neighbours, scaled);
  if (result.min == result.max)
    for (double& value : result.normalized) value = unit.toMeshLength(value);
  result.min = unit.toMeshLength(result.min);
  result.max = unit.toMeshLength(result.max);
  return result;
}

uint32_t countSegments(std::span<const uint32_t> segments) {
  uint32_t count = 0;
  for (const uint32_t segment : segments)
    if (segment != kNoSegment) count = std::max(count, segment + 1);
  return count;
}

}  // namespace

SegmentedValues segmentValues(const PreparedMesh& prepared, std::span<const double> values, const Options& options,
                              StageClock& clock, Report& report, const RunControl& control) {
  SegmentedValues result;
  if (!options.postprocesses()) return result;
  control.checkpoint(0);
  FaceNeighbours neighbours;
  {
    const auto scope = clock.time(Stage::Postprocess);
    neighbours = findFaceNeighbours(prepared.mesh);
    CgalValues postprocessed = postprocess(prepared, neighbours, values);
    report.postprocess = PostprocessReport{postprocessed.min, postprocessed.max};
    result.normalized = std::move(postprocessed.normalized);
  }
  if (options.segmentation != Segmentation::Cgal) return result;
  control.checkpoint(0.5);
  const auto scope = clock.time(Stage::Segment);
  const CgalSegmentation segmentation =
      segmentLikeCgal(prepared.geometry, prepared.mesh, neighbours, result.normalized, options.cgalSegmentation);
  result.segments = segmentsOfInputFaces(prepared.mesh, segmentation.segments, prepared.geometry.areas);
  report.segmentation = SegmentationReport{countSegments(result.segments)};
  return result;
}

}  // namespace asdfvk
