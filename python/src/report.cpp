#include "report.h"

#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>

namespace py = pybind11;
using namespace pybind11::literals;

namespace asdfvk::python {
namespace {

/// None where `value` is unset.
template <typename T, typename Convert>
py::object optional(const std::optional<T>& value, Convert convert) {
  if (!value) return py::none();
  return convert(*value);
}

py::dict dictOf(const ErrorEstimate& estimate) {
  py::list worst;
  for (const ErrorEstimate::WorstFace& face : estimate.worstFaces)
    worst.append(py::dict("face"_a = face.face, "error"_a = face.error));
  return py::dict("average"_a = estimate.average, "standard_error"_a = estimate.standardError,
                  "robust_average"_a = estimate.robustAverage, "relative_median"_a = estimate.relativeMedian,
                  "relative_percentile90"_a = estimate.relativePercentile90,
                  "relative_median_standard_error"_a = estimate.relativeMedianStandardError,
                  "held_out_count"_a = estimate.heldOutCount, "worst_faces"_a = worst);
}

py::dict dictOf(const CheckReport& check) {
  return py::dict("passed"_a = check.passed, "is_independent"_a = check.isIndependent,
                  "traced_count"_a = check.tracedCount, "agreeing_count"_a = check.agreeingCount,
                  "no_value_agree_count"_a = check.noValueAgreeCount, "median_difference"_a = check.medianDifference,
                  "worst_difference"_a = check.worstDifference, "worst_face"_a = check.worstFace,
                  "compared_count"_a = check.comparedCount, "average_error"_a = check.averageError,
                  "maximum_error"_a = check.maximumError, "interpolated_count"_a = check.interpolatedCount,
                  "interpolated_average_error"_a = check.interpolatedAverageError,
                  "interpolated_maximum_error"_a = check.interpolatedMaximumError);
}

py::dict dictOf(const ValueRange& range) {
  return py::dict("min"_a = range.min, "percentile1"_a = range.percentile1, "median"_a = range.median,
                  "percentile99"_a = range.percentile99, "max"_a = range.max);
}

py::dict dictOf(const SolverReport& solver) {
  return py::dict("name"_a = solver.name, "iterations"_a = solver.iterations,
                  "relative_residual"_a = solver.relativeResidual, "converged"_a = solver.converged,
                  "finished_on_cpu"_a = solver.finishedOnCpu);
}

py::dict dictOf(const PartsReport& parts) {
  return py::dict("fewest_count"_a = parts.fewestCount, "most_count"_a = parts.mostCount,
                  "agreement"_a = parts.agreement, "is_thin_shell"_a = parts.isThinShell,
                  "area_shares"_a = parts.areaShares);
}

py::tuple tupleOf(const Vec3d& point) { return py::make_tuple(point.x, point.y, point.z); }

py::dict dictOf(const ThinRegion& region) {
  return py::dict("is_sharp"_a = region.isSharp, "min"_a = region.min, "min_face"_a = region.minFace,
                  "place"_a = tupleOf(region.place), "opposite"_a = tupleOf(region.opposite),
                  "face_count"_a = region.faceCount, "area"_a = region.area, "area_share"_a = region.areaShare);
}

py::dict dictOf(const SharpEdge& edge) {
  return py::dict("angle_degrees"_a = edge.angleDegrees, "length"_a = edge.length, "edge_count"_a = edge.edgeCount,
                  "place"_a = tupleOf(edge.place), "face"_a = edge.face);
}

py::dict dictOf(const SectionBall& ball) {
  return py::dict("diameter"_a = ball.diameter, "centre"_a = tupleOf(ball.centre));
}

py::dict dictOf(const UnjudgedFaces& unjudged) {
  return py::dict("open_count"_a = unjudged.openCount, "inverted_count"_a = unjudged.invertedCount,
                  "degenerate_count"_a = unjudged.degenerateCount, "crossed_count"_a = unjudged.crossedCount,
                  "self_crossed_count"_a = unjudged.selfCrossedCount);
}

template <typename Item>
py::list listOfDicts(const std::vector<Item>& items) {
  py::list list;
  for (const Item& item : items) list.append(dictOf(item));
  return list;
}

py::dict dictOf(const ThicknessReport& thickness) {
  const auto ofMin = [&](const py::object& value) {
    return std::isnan(thickness.min) ? py::object(py::none()) : value;
  };
  py::dict dict("min"_a = thickness.min, "min_face"_a = ofMin(py::cast(thickness.minFace)),
                "min_place"_a = ofMin(tupleOf(thickness.minPlace)),
                "min_opposite"_a = ofMin(tupleOf(thickness.minOpposite)), "percentile1"_a = thickness.percentile1,
                "percentile5"_a = thickness.percentile5, "median"_a = thickness.median,
                "percentile95"_a = thickness.percentile95, "max"_a = thickness.max);
  dict["verdict"] = optional(thickness.verdict, [](ThicknessVerdict verdict) { return py::str(nameOf(verdict)); });
  dict["thinner_than"] = thickness.thinnerThan;
  dict["allow_sharp_edges"] = thickness.allowsSharpEdges;
  dict["no_value_count"] = thickness.noValueCount;
  dict["unjudged"] = dictOf(thickness.unjudged);
  dict["greatest_section"] = optional(thickness.greatestSection, [](const SectionBall& ball) { return dictOf(ball); });
  dict["sharp_edges"] = listOfDicts(thickness.sharpEdges);
  dict["thin_area"] = thickness.thinArea;
  dict["thin_area_share"] = thickness.thinAreaShare;
  dict["regions"] = listOfDicts(thickness.thinRegions);
  return dict;
}

py::dict dictOf(const MeshDefects& defects) {
  return py::dict(
      "zero_area_face_count"_a = defects.zeroAreaFaceCount, "duplicate_face_count"_a = defects.duplicateFaceCount,
      "non_finite_vertex_count"_a = defects.nonFiniteVertexCount,
      "non_finite_face_count"_a = defects.nonFiniteFaceCount, "boundary_edge_count"_a = defects.boundaryEdgeCount,
      "non_manifold_edge_count"_a = defects.nonManifoldEdgeCount,
      "inconsistent_edge_count"_a = defects.inconsistentEdgeCount,
      "unreferenced_vertex_count"_a = defects.unreferencedVertexCount,
      "short_polygon_count"_a = defects.shortPolygonCount);
}

py::dict dictOf(const StageSeconds& seconds) {
  py::dict stages;
  for (size_t i = 0; i < kStageCount; ++i) stages[nameOf(static_cast<Stage>(i))] = seconds.seconds[i];
  return stages;
}

}  // namespace

py::list listOf(const std::vector<Warning>& warnings) {
  py::list list;
  for (const Warning& warning : warnings)
    list.append(py::dict("code"_a = nameOf(warning.code), "message"_a = textOf(warning.message),
                         "details"_a = dictOf(warning.details)));
  return list;
}

py::str textOf(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape"));
}

py::dict dictOf(const std::vector<ErrorDetail>& details) {
  py::dict dict;
  for (const ErrorDetail& detail : details) dict[textOf(detail.name)] = textOf(detail.value);
  return dict;
}

py::dict dictOf(const Report& report) {
  const auto convert = [](const auto& value) { return dictOf(value); };
  py::dict dict("face_count"_a = report.faceCount, "region_face_count"_a = report.regionFaceCount,
                "triangle_count"_a = report.triangleCount, "vertex_count"_a = report.vertexCount,
                "component_count"_a = report.componentCount, "size"_a = tupleOf(report.size),
                "seed_count"_a = report.seedCount, "ray_count"_a = report.rayCount,
                "redone_cone_count"_a = report.redoneConeCount, "no_value_count"_a = report.noValueCount,
                "clamped_count"_a = report.clampedCount, "random_seed"_a = report.randomSeed,
                "round_count"_a = report.roundCount);
  dict["backend"] = report.backend;
  dict["device"] = report.device;
  dict["runs_on_cpu"] = report.runsOnCpu;
  dict["stage_seconds"] = dictOf(report.stageSeconds);
  dict["rays_per_second"] = report.raysPerSecond;
  dict["trace_device_seconds"] = optional(report.traceDeviceSeconds, [](double seconds) { return py::cast(seconds); });
  dict["solver"] = dictOf(report.solver);
  dict["sdf"] = dictOf(report.sdf);
  dict["normalized_range"] =
      optional(report.postprocess, [](const PostprocessReport& range) { return py::make_tuple(range.min, range.max); });
  dict["segment_count"] =
      optional(report.segmentation, [](const SegmentationReport& segments) { return py::cast(segments.segmentCount); });
  dict["parts"] =
      report.segmentation ? optional(report.segmentation->parts, convert) : static_cast<py::object>(py::none());
  dict["thickness"] = optional(report.thickness, convert);
  dict["defects"] = dictOf(report.defects);
  dict["reversed_faces"] = report.reversedFaces;
  dict["warnings"] = listOf(report.warnings);
  dict["estimated_error"] = optional(report.estimatedError, convert);
  dict["check"] = optional(report.check, convert);
  return dict;
}

}  // namespace asdfvk::python
