#include "pipeline/segments.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "describe/warnings.h"
#include "pipeline/input_face_values.h"
#include "pipeline/segment_boundaries.h"
#include "segment/assembly_parts.h"
#include "segment/cgal_postprocess.h"
#include "segment/cgal_segmentation.h"
#include "trace/sight_tracer.h"

namespace asdfvk {
namespace {

/// If PartsReport::agreement is lower than this, the result has a warning.
constexpr double kMinAgreement = 0.9;
/// A face is coarse if its size divided by its shape diameter is greater than this.
constexpr double kMaxFaceSize = 0.5;
/// If coarse faces have a greater share of the area than this, the result has a warning.
constexpr double kMaxCoarseShare = 0.1;

/// The share of the area that each segment has, from areas of triangles (#F) and segments of input faces.
std::vector<double> areaSharesOf(const TriangleMesh& mesh, std::span<const double> areas,
                                 std::span<const uint32_t> segments, uint32_t count) {
  std::vector<double> shares(count, 0);
  double sum = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    shares[segments[mesh.inputFaceOf(face)]] += areas[face];
    sum += areas[face];
  }
  for (double& share : shares) share /= sum;
  return shares;
}

/// Share of the area of faces whose size, the edge of a regular triangle of their area, is above kMaxFaceSize.
double coarseShareOf(const PreparedMesh& prepared, std::span<const double> values, std::span<const double> areas) {
  double share = 0;
  for (uint32_t face = 0; face < values.size(); ++face) {
    const double size = std::sqrt(4 / std::sqrt(3.0) * prepared.geometry.areas[face]);
    if (size > kMaxFaceSize * values[face]) share += areas[face];  // False without a value.
  }
  return share;
}

void warnAboutParts(const PreparedMesh& prepared, std::span<const double> values, const Parts& parts,
                    const Options& options, Report& report) {
  if (parts.agreement && *parts.agreement < kMinAgreement) report.warnings.push_back(uncertainParts(*parts.agreement));
  if (const double share = coarseShareOf(prepared, values, parts.areas); share > kMaxCoarseShare)
    report.warnings.push_back(coarseParts(share));
  if (parts.isThinShell) report.warnings.push_back(thinShell(parts.meanSight));
  if (!parts.agreement) report.warnings.push_back(onlySmallComponents(kMinPartArea, parts.partCount));
  const auto requested = options.parts.partCount;
  if (requested && *requested != report.segmentCount)
    report.warnings.push_back(partCountDiffers(*requested, *report.segmentCount));
}

void segmentByParts(const PreparedMesh& prepared, std::span<const double> values, const Options& options,
                    const LineOfSight& sight, const RunControl& control, Report& report, SegmentedValues& result) {
  const PartsInput input{prepared.mesh, prepared.geometry, prepared.graph, prepared.components, values};
  const bool isAssembly = prepared.statedPartCount > 1 && !options.parts.partCount;
  const Parts parts = isAssembly ? segmentAssembly(input, options.parts, sight, control)
                                 : segmentIntoParts(input, options.parts, sight, control);
  result.segments = segmentsOfInputFaces(prepared.mesh, parts.partOf, parts.areas);
  const uint32_t count = countSegments(result.segments);
  report.segmentCount = count;
  SegmentBoundaries boundaries = boundariesOfInputFaces(prepared, parts, result.segments);
  result.boundaryStability = std::move(boundaries.stability);
  report.parts = PartsReport{parts.fewest,
                             parts.most,
                             parts.agreement,
                             parts.isThinShell,
                             areaSharesOf(prepared.mesh, parts.areas, result.segments, count),
                             std::move(boundaries.list)};
  warnAboutParts(prepared, values, parts, options, report);
}

}  // namespace

SegmentedValues segmentValues(const PreparedMesh& prepared, std::span<const double> values, const Options& options,
                              const LineOfSight& sight, StageClock& clock, Report& report, const RunControl& control) {
  SegmentedValues result;
  control.checkpoint(0);
  FaceNeighbours neighbours;
  if (options.postprocesses()) {
    const auto scope = clock.time(Stage::Postprocess);
    neighbours = findFaceNeighbours(prepared.mesh);
    CgalValues postprocessed = postprocessLikeCgal(neighbours, values, control);
    report.postprocess = PostprocessReport{postprocessed.min, postprocessed.max};
    result.normalized = std::move(postprocessed.normalized);
  }
  if (options.segmentation == Segmentation::None) return result;
  control.checkpoint(0.5);
  const auto scope = clock.time(Stage::Segment);
  if (options.segmentation == Segmentation::Parts) {
    segmentByParts(prepared, values, options, sight, control, report, result);
    return result;
  }
  const CgalSegmentation segmentation = segmentLikeCgal(prepared.geometry, prepared.mesh, neighbours, result.normalized,
                                                        options.cgalSegmentation, control);
  result.segments = segmentsOfInputFaces(prepared.mesh, segmentation.segments, prepared.geometry.areas);
  report.segmentCount = countSegments(result.segments);
  return result;
}

LineOfSight makeLineOfSight(const TraceScene& scene, bool usesReference, const RunControl& control) {
  std::shared_ptr<SightTracer> tracer;
  return [=](std::span<const LineSegment> segments) mutable {
    control.checkpoint(0);
    if (!tracer) tracer = usesReference ? makeReferenceSightTracer(scene) : makeCpuSightTracer(scene);
    std::vector<uint8_t> isClear(segments.size());
    tracer->trace(segments, isClear);
    return isClear;
  };
}

}  // namespace asdfvk
