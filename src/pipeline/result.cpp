#include "pipeline/result.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/median.h"
#include "core/text.h"

namespace asdfvk {
namespace {

/// A mean normal that is shorter has no direction: the triangles of the polygon face each other.
constexpr double kNoNormal = 1e-9;

// The range is no scale for errors where the robust range is below this share of it, or where the median relative error
// is large and far above the average error over the range. No clean mesh is near (docs/accuracy.md).
constexpr double kMinRobustShare = 0.1, kLargeRelativeError = 0.1, kMaxRelativeOverAverage = 5;

/// Likely reasons of missing values.
struct MissingCauses {
  bool isInverted = false;  ///< A face without a value belongs to an inverted component.
  bool isOpen = false;      ///< A face without a value belongs to an open component.
};

MissingCauses causesOf(const PreparedMesh& prepared, const FaceDomain& domain, std::span<const double> values) {
  std::vector<uint8_t> isInverted(prepared.components.components.size(), 0);
  for (const uint32_t index : prepared.invertedComponents) isInverted[index] = 1;
  MissingCauses causes;
  for (uint32_t f = 0; f < prepared.mesh.faceCount(); ++f) {
    if (!std::isnan(values[f]) || prepared.geometry.isDegenerate(f) || !domain.contains(prepared.mesh.inputFaceOf(f)))
      continue;
    const uint32_t component = prepared.components.componentOf[f];
    causes.isInverted = causes.isInverted || isInverted[component];
    causes.isOpen = causes.isOpen || !prepared.components.components[component].isClosed;
  }
  causes.isOpen = causes.isOpen && prepared.defects.boundaryEdgeCount > 0;
  return causes;
}

Warning missingValues(const Report& report, const MissingCauses& causes, bool keepsMissing) {
  Warning warning{WarningCode::MissingValues,
                  fmt::format("{} of {} without a value: no ray from these faces{} hit the opposite side of the shape",
                              report.noValueCount, counted(report.regionFaceCount, "face"),
                              keepsMissing ? "" : ", or from faces connected to them,"),
                  {}};
  const std::string inverted = "their component is inverted";
  const std::string open = "the surface is open, so that rays escape, or its faces are oriented inwards";
  if (causes.isInverted) warning.details.push_back({"cause", "inverted"});
  if (causes.isOpen) warning.details.push_back({"cause", "open"});
  if (causes.isInverted || causes.isOpen)
    warning.message += ", most likely because " + (causes.isInverted ? inverted : std::string()) +
                       (causes.isInverted && causes.isOpen ? ", or " : "") + (causes.isOpen ? open : std::string());
  return warning;
}

ValueRange rangeOf(const std::vector<double>& values) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present), [](double v) { return !std::isnan(v); });
  if (present.empty()) return {};
  const auto [low, high] = std::minmax_element(present.begin(), present.end());
  ValueRange range{.min = *low, .max = *high};
  range.median = upperMedian(present);
  range.percentile1 = percentileOf(present, 0.01);
  range.percentile99 = percentileOf(present, 0.99);
  return range;
}

/// The warning where errors over the range are reported and look small only because of the range.
std::optional<Warning> rangeDominated(const Report& report) {
  if (!report.estimatedError && !report.check) return std::nullopt;
  const double robustShare = report.sdf.robustRange() / (report.sdf.max - report.sdf.min);
  const ErrorEstimate estimate = report.estimatedError.value_or(ErrorEstimate{});
  const bool isLarge = estimate.relativeMedian > kLargeRelativeError &&
                       estimate.relativeMedian > kMaxRelativeOverAverage * estimate.average;
  if (!isLarge && !(robustShare < kMinRobustShare)) return std::nullopt;
  Warning warning{WarningCode::RangeDominated,
                  fmt::format("a few faces have most of the range of the values (98 % of the faces are within {:.2g} % "
                              "of it), so that errors over the range look small",
                              100 * robustShare),
                  {{"robustShare", fmt::format("{:.6g}", robustShare)}}};
  if (isLarge)
    warning.message = fmt::format(
        "most values are small against their range, so that errors over the range look small: {:.2g} % of the range on "
        "average, but {:.0f} % of the value in the median",
        100 * estimate.average, 100 * estimate.relativeMedian);
  return warning;
}

/// Numbers the labels in use 0, 1, ... in their order.
void renumber(std::vector<uint32_t>& labels, size_t labelCount) {
  std::vector<uint32_t> newLabels(labelCount, kNoSegment);
  for (const uint32_t label : labels)
    if (label != kNoSegment) newLabels[label] = 0;
  uint32_t count = 0;
  for (uint32_t& label : newLabels)
    if (label != kNoSegment) label = count++;
  for (uint32_t& label : labels)
    if (label != kNoSegment) label = newLabels[label];
}

}  // namespace

std::vector<double> valuesOfInputFaces(const TriangleMesh& mesh, std::span<const double> values,
                                       std::span<const double> areas) {
  if (mesh.polygons.isEmpty()) return {values.begin(), values.end()};
  std::vector<double> sums(mesh.inputFaceCount(), 0), weights(mesh.inputFaceCount(), 0);
  std::vector<double> last(mesh.inputFaceCount(), kNoValue);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    if (std::isnan(values[face])) continue;
    const uint32_t inputFace = mesh.polygons.inputFaceOf[face];
    sums[inputFace] += areas[face] * values[face];
    weights[inputFace] += areas[face];
    last[inputFace] = values[face];
  }
  // Where all valued triangles have zero area, the value of the last one stays.
  for (size_t i = 0; i < sums.size(); ++i)
    if (weights[i] > 0) last[i] = sums[i] / weights[i];
  return last;
}

std::vector<uint8_t> seedsOfInputFaces(const TriangleMesh& mesh, std::span<const uint8_t> isSeed) {
  if (mesh.polygons.isEmpty()) return {isSeed.begin(), isSeed.end()};
  std::vector<uint8_t> seeds(mesh.inputFaceCount(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) seeds[mesh.polygons.inputFaceOf[face]] |= isSeed[face];
  return seeds;
}

uint32_t labelOfLargestArea(std::vector<std::pair<uint32_t, double>>& areas) {
  std::stable_sort(areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  double largest = -1, sum = 0;
  uint32_t best = kNoSegment;
  for (size_t i = 0; i < areas.size(); ++i) {
    const auto [label, area] = areas[i];
    sum = i > 0 && areas[i - 1].first == label ? sum + area : area;
    if (sum <= largest) continue;
    largest = sum;
    best = label;
  }
  return best;
}

std::vector<uint32_t> labelsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> labels,
                                         std::span<const double> areas) {
  if (mesh.polygons.isEmpty()) return {labels.begin(), labels.end()};
  std::vector<uint32_t> ofInputFaces(mesh.inputFaceCount(), kNoSegment);
  std::vector<std::pair<uint32_t, double>> areaOf;  // Of the labels of a polygon.
  for (uint32_t begin = 0, end = 0; begin < mesh.faceCount(); begin = end) {
    const uint32_t inputFace = mesh.inputFaceOf(begin);
    areaOf.clear();
    for (; end < mesh.faceCount() && mesh.inputFaceOf(end) == inputFace; ++end)
      areaOf.emplace_back(labels[end], areas[end]);
    ofInputFaces[inputFace] = labelOfLargestArea(areaOf);
  }
  return ofInputFaces;
}

std::vector<uint32_t> segmentsOfInputFaces(const TriangleMesh& mesh, std::span<const uint32_t> segments,
                                           std::span<const double> areas) {
  std::vector<uint32_t> ofInputFaces = labelsOfInputFaces(mesh, segments, areas);
  if (!mesh.polygons.isEmpty()) renumber(ofInputFaces, *std::max_element(segments.begin(), segments.end()) + size_t{1});
  return ofInputFaces;
}

uint32_t countSegments(std::span<const uint32_t> segments) {
  uint32_t count = 0;
  for (const uint32_t segment : segments)
    if (segment != kNoSegment) count = std::max(count, segment + 1);
  return count;
}

std::vector<double> centresOfInputFaces(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                        std::span<const double> sdf) {
  std::vector<Vec3d> places(sdf.size()), normals(sdf.size());
  std::vector<double> areas(sdf.size(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    if (geometry.isDegenerate(face)) continue;
    const uint32_t inputFace = mesh.inputFaceOf(face);
    areas[inputFace] += geometry.areas[face];
    const double share = geometry.areas[face] / areas[inputFace];  // Means by increments: they cannot overflow.
    places[inputFace] += (geometry.barycentres[face] - places[inputFace]) * share;
    normals[inputFace] += (geometry.normals[face] - normals[inputFace]) * share;
  }
  std::vector<double> centres(3 * sdf.size(), kNoValue);
  for (size_t i = 0; i < sdf.size(); ++i) {
    const double norm = length(normals[i]);
    if (std::isnan(sdf[i]) || !(norm > kNoNormal)) continue;
    const Vec3d centre = places[i] - normals[i] * (sdf[i] / 2 / norm);
    for (size_t axis = 0; axis < 3; ++axis) centres[3 * i + axis] = centre[axis];
  }
  return centres;
}

uint64_t countWithoutValue(const FaceDomain& domain, std::span<const double> field) {
  uint64_t count = 0;
  for (size_t i = 0; i < field.size(); ++i) count += std::isnan(field[i]) && domain.contains(i) ? 1 : 0;
  return count;
}

void describeValues(Report& report, const PreparedMesh& prepared, const FaceDomain& domain,
                    const std::vector<double>& sdf, std::span<const double> values, bool keepsMissing) {
  report.sdf = rangeOf(sdf);
  report.noValueCount = countWithoutValue(domain, sdf);
  if (report.noValueCount > 0)
    report.warnings.push_back(missingValues(report, causesOf(prepared, domain, values), keepsMissing));
  if (std::optional<Warning> warning = rangeDominated(report)) report.warnings.push_back(std::move(*warning));
  if (report.solver.finishedOnCpu)
    report.warnings.push_back(
        {WarningCode::FinishedOnCpu,
         fmt::format("the {} solver reached the limit of float32 on the device; the CPU continued in double precision",
                     report.solver.name),
         {}});
  if (!report.solver.converged)
    report.warnings.push_back(
        {WarningCode::NotConverged,
         fmt::format("the {} solver stopped after {} at a relative residual of {:.1e}", report.solver.name,
                     counted(report.solver.iterations, "iteration"), report.solver.relativeResidual),
         {}});
}

const char* nameOf(Stage stage) {
  constexpr std::array<const char*, kStageCount> kNames{
      "read",      "geometry", "graph", "bvh",      "encode", "upload",      "sample",  "trace",
      "thickness", "predict",  "solve", "estimate", "smooth", "postprocess", "segment", "write"};
  return kNames[static_cast<size_t>(stage)];
}

const char* nameOf(ThicknessVerdict verdict) {
  constexpr std::array<const char*, 3> kNames{"passed", "failed", "notJudged"};
  return kNames[static_cast<size_t>(verdict)];
}

const char* nameOf(WarningCode code) {
  switch (code) {
    case WarningCode::MeshDefect:
      return "meshDefect";
    case WarningCode::InvertedComponents:
      return "invertedComponents";
    case WarningCode::ComponentsReversed:
      return "componentsReversed";
    case WarningCode::MissingValues:
      return "missingValues";
    case WarningCode::FinishedOnCpu:
      return "finishedOnCpu";
    case WarningCode::BackendReplaced:
      return "backendReplaced";
    case WarningCode::PredictedOnCpu:
      return "predictedOnCpu";
    case WarningCode::SolvedOnCpu:
      return "solvedOnCpu";
    case WarningCode::NotConverged:
      return "notConverged";
    case WarningCode::RangeDominated:
      return "rangeDominated";
    case WarningCode::ThinShell:
      return "thinShell";
    case WarningCode::PartCountDiffers:
      return "partCountDiffers";
    case WarningCode::OnlySmallComponents:
      return "onlySmallComponents";
  }
  return "unknown";
}

}  // namespace asdfvk
