#include "report.h"

#include <pybind11/stl.h>

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

py::dict dictOf(const ThinRegion& region) {
  return py::dict("face_count"_a = region.faceCount, "area"_a = region.area, "area_share"_a = region.areaShare,
                  "min"_a = region.min, "min_face"_a = region.minFace,
                  "place"_a = py::make_tuple(region.place.x, region.place.y, region.place.z));
}

py::dict dictOf(const ThicknessReport& thickness) {
  py::list regions;
  for (const ThinRegion& region : thickness.thinRegions) regions.append(dictOf(region));
  return py::dict(
      "min"_a = thickness.min, "percentile1"_a = thickness.percentile1, "percentile5"_a = thickness.percentile5,
      "median"_a = thickness.median, "percentile95"_a = thickness.percentile95, "max"_a = thickness.max,
      "no_value_count"_a = thickness.noValueCount,
            "redone_ball_count"_a = thickness.redoneBallCount, "thinner_than"_a = thickness.thinnerThan,
      "thin_area"_a = thickness.thinArea, "thin_area_share"_a = thickness.thinAreaShare, "thin_regions"_a = regions);
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
                "component_count"_a = report.componentCount, "seed_count"_a = report.seedCount,
                "ray_count"_a = report.rayCount, "redone_cone_count"_a = report.redoneConeCount,
                "no_value_count"_a = report.noValueCount, "random_seed"_a = report.randomSeed,
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
