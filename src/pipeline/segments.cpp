#include "pipeline/segments.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/text.h"
#include "pipeline/input_face_values.h"
#include "segment/cgal_postprocess.h"
#include "segment/cgal_segmentation.h"
#include "trace/sight_tracer.h"

namespace asdfvk {
namespace {

/// Sums of the areas of the triangles (#F), by the segment of their input face; divided by the sum of all.
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

void warnAboutParts(const Parts& parts, const Options& options, Report& report) {
  if (parts.isThinShell)
    report.warnings.push_back(
        {WarningCode::ThinShell,
         fmt::format("the shape is a thin wall around a cavity: {:.0f} % of the pairs of its patches have a clear "
                     "line of sight; its parts are less certain than those of solid shapes",
                     100 * parts.meanSight),
         {}});
  const uint32_t count = report.segmentation->segmentCount;
  if (!parts.agreement)
    report.warnings.push_back(
        {WarningCode::OnlySmallComponents,
         fmt::format("no component has {:g} % of the area, so each of the {} components is a part", 100 * kMinPartArea,
                     groupDigits(parts.partCount)),
         {}});
  if (const auto requested = options.parts.partCount; requested && *requested != count)
    report.warnings.push_back(
        {WarningCode::PartCountDiffers,
         *requested < count
             ? fmt::format("{} requested; the mesh has {} because a part does not extend over several components",
                           counted(*requested, "part"), count)
             : fmt::format("{} requested; the mesh can be divided into {} only", counted(*requested, "part"), count),
         {}});
}

void segmentByParts(const PreparedMesh& prepared, std::span<const double> values, const Options& options,
                    const LineOfSight& sight, const RunControl& control, Report& report, SegmentedValues& result) {
  const Parts parts = segmentIntoParts({prepared.mesh, prepared.geometry, prepared.graph, prepared.components, values},
                                       options.parts, sight, control);
  result.segments = segmentsOfInputFaces(prepared.mesh, parts.partOf, parts.areas);
  const uint32_t count = countSegments(result.segments);
  report.segmentation =
      SegmentationReport{count, PartsReport{parts.fewest, parts.most, parts.agreement, parts.isThinShell,
                                            areaSharesOf(prepared.mesh, parts.areas, result.segments, count)}};
  warnAboutParts(parts, options, report);
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
  report.segmentation = SegmentationReport{countSegments(result.segments), {}};
  return result;
}

LineOfSight makeLineOfSight(const TraceScene& scene, bool usesReference, const RunControl& control) {
  std::shared_ptr<SightTracer> tracer;
  return [=](std::span<const LineSegment> segments) mutable {
    control.checkpoint(0);
    if (!tracer)
      tracer = usesReference || !hasEmbree() ? makeReferenceSightTracer(scene) : makeEmbreeSightTracer(scene);
    std::vector<uint8_t> isClear(segments.size());
    tracer->trace(segments, isClear);
    return isClear;
  };
}

bool sightNeedsNodes(const Options& options, bool usesReference) {
  return options.segmentation == Segmentation::Parts && (usesReference || !hasEmbree());
}

}  // namespace asdfvk
