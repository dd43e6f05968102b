#include "describe/warnings.h"

#include <fmt/core.h>

#include <utility>

#include "core/text.h"
#include "describe/report_keys.h"

namespace asdfvk {
namespace {

std::string numberText(double number) { return fmt::format("{:.6g}", number); }

std::vector<ErrorDetail> detailsOf(const Error& failure) {
  return {{"code", nameOf(failure.code())}, {"failure", failure.what()}};
}

std::vector<ErrorDetail> detailsOf(const SolverReport& solver) {
  return {{"solver", solver.name},
          {"iterations", std::to_string(solver.iterations)},
          {"relativeResidual", numberText(solver.relativeResidual)}};
}

}  // namespace

static_assert(kStageNames.size() == kStageCount);

const char* nameOf(Stage stage) { return nameOf(kStageNames, stage); }
const char* nameOf(ThinKind kind) { return nameOf(kThinKindNames, kind); }
const char* nameOf(ThicknessVerdict verdict) { return nameOf(kThicknessVerdictNames, verdict); }
const char* nameOf(WallChange change) { return nameOf(kWallChangeNames, change); }
const char* nameOf(UnjudgedCause cause) { return nameOf(kUnjudgedCauseNames, cause); }
bool concernsWholeMesh(UnjudgedCause cause) {
  return cause == UnjudgedCause::NegativeVolumes || cause == UnjudgedCause::CoarseCoordinates;
}
const char* nameOf(FindingKind kind) { return nameOf(kFindingKindNames, kind); }
const char* nameOf(FindingLevel level) { return nameOf(kFindingLevelNames, level); }
const char* nameOf(WarningCode code) { return nameOf(kWarningCodeNames, code); }

std::vector<Warning> warningsOf(const MeshDefects& defects, bool isOfPolygons) {
  std::vector<Warning> warnings;
  const auto add = [&](const char* key, uint64_t count, const std::string& one, const std::string& many) {
    if (count > 0)
      warnings.push_back({WarningCode::MeshDefect,
                          fmt::format("{} {}", count, count == 1 ? one : many),
                          {{"defect", key}, {"count", std::to_string(count)}}});
  };
  const std::string face = isOfPolygons ? "triangle " : "face ", faces = isOfPolygons ? "triangles " : "faces ";
  add("nonFiniteVertexCount", defects.nonFiniteVertexCount, "vertex has a coordinate that is not a finite number",
      "vertices have coordinates that are not finite numbers");
  add("nonFiniteFaceCount", defects.nonFiniteFaceCount,
      face + "has a corner that is not finite: it is ignored and gets no value",
      faces + "have corners that are not finite: they are ignored and get no value");
  add("shortPolygonCount", defects.shortPolygonCount, "input face has fewer than three corners: it gets no value",
      "input faces have fewer than three corners: they get no value");
  add("zeroAreaFaceCount", defects.zeroAreaFaceCount, face + "has zero area: it casts no rays",
      faces + "have zero area: they cast no rays");
  add("duplicateFaceCount", defects.duplicateFaceCount,
      face + "duplicates an earlier face: the rays of a face ignore its copies",
      faces + "duplicate earlier ones: the rays of a face ignore its copies");
  add("nonManifoldEdgeCount", defects.nonManifoldEdgeCount,
      "edge has more than two faces: two solids touch there, or inside and outside are not defined",
      "edges have more than two faces: two solids touch there, or inside and outside are not defined");
  add("inconsistentEdgeCount", defects.inconsistentEdgeCount,
      "edge has two faces of opposite winding: on one side of it rays leave the solid",
      "edges have two faces of opposite winding: on one side of them rays leave the solid");
  add("boundaryEdgeCount", defects.boundaryEdgeCount,
      "edge has only one face: the surface is open there and rays can escape",
      "edges have only one face: the surface is open there and rays can escape");
  add("weldedVertexCount", defects.weldedVertexCount,
      "vertex was welded to another one at the same point: the surface would be open there",
      "vertices were welded to others at the same points: the surface would be open there");
  add("unreferencedVertexCount", defects.unreferencedVertexCount, "vertex belongs to no triangle: it is ignored",
      "vertices belong to no triangle: they are ignored");
  return warnings;
}

Warning componentsReversed(uint64_t count) {
  return {WarningCode::ComponentsReversed,
          fmt::format("{} inverted component{} reversed", count, count == 1 ? " was" : "s were"),
          {{"count", std::to_string(count)}}};
}

Warning facesReversed(uint64_t count) {
  return {WarningCode::FacesReversed,
          fmt::format("{} wound against {} neighbours {} reversed", counted(count, "face"),
                      count == 1 ? "its" : "their", count == 1 ? "was" : "were"),
          {{"count", std::to_string(count)}}};
}

Warning missingValues(const MissingValues& missing) {
  Warning warning{WarningCode::MissingValues,
                  fmt::format("{} of {} without a value: no ray from these faces{} hit the opposite side of the shape",
                              missing.count, counted(missing.faceCount, "face"),
                              missing.keepsMissing ? "" : ", or from faces connected to them,"),
                  {{"count", std::to_string(missing.count)}}};
  if (!missing.isInverted && !missing.isOpen) return warning;
  const char* const both = missing.isInverted && missing.isOpen ? ", or " : "";
  warning.message +=
      fmt::format(", most likely because {}{}{}", missing.isInverted ? "their component is inverted" : "", both,
                  missing.isOpen ? "the surface is open, so that rays escape, or its faces are oriented inwards" : "");
  warning.details.push_back({"cause", fmt::format("{}{}{}", missing.isInverted ? "inverted" : "",
                                                  *both != 0 ? " or " : "", missing.isOpen ? "open" : "")});
  return warning;
}

Warning rangeDominated(double robustShare) {
  return {WarningCode::RangeDominated,
          fmt::format("a few faces span most of the range of the values (98 % of the faces are within {:.2g} % of the "
                      "range), so that errors divided by the range look small",
                      100 * robustShare),
          {{"robustShare", numberText(robustShare)}}};
}

Warning rangeDominated(double robustShare, const ErrorEstimate& estimate) {
  return {WarningCode::RangeDominated,
          fmt::format("most values are small compared with their range, so that errors divided by the range look "
                      "small: {:.2g} % of the range on average, but {:.0f} % of the value in the median",
                      100 * estimate.average, 100 * estimate.relativeMedian),
          {{"robustShare", numberText(robustShare)}}};
}

Warning finishedOnCpu(const SolverReport& solver) {
  return {WarningCode::FinishedOnCpu,
          fmt::format("the {} solver reached the limit of float32 on the device; the CPU continued in double precision",
                      solver.name),
          detailsOf(solver)};
}

Warning notConverged(const SolverReport& solver) {
  return {WarningCode::NotConverged,
          fmt::format("the {} solver stopped after {} at a relative residual of {:.1e}", solver.name,
                      counted(solver.iterations, "iteration"), solver.relativeResidual),
          detailsOf(solver)};
}

Warning backendReplaced(const std::string& failed, const std::string& next, const Error& failure) {
  return {WarningCode::BackendReplaced,
          fmt::format("the backend {} replaces {}, which failed: {}", next, failed, failure.what()),
          {{"failed", failed}, {"code", nameOf(failure.code())}}};
}

Warning predictedOnCpu(const Error& failure) {
  return {WarningCode::PredictedOnCpu,
          fmt::format("the CPU predicted values because the device could not: {}", failure.what()), detailsOf(failure)};
}

Warning solvedOnCpu(const Error& failure) {
  return {WarningCode::SolvedOnCpu,
          fmt::format("the CPU solved the equation because the device failed: {}", failure.what()), detailsOf(failure)};
}

Warning thinShell(double clearShare) {
  return {
      WarningCode::ThinShell,
      fmt::format("the shape is a thin wall around a cavity: {:.0f} % of the pairs of its patches have a clear line "
                  "of sight; its parts are less certain than the parts of solid shapes",
                  100 * clearShare),
      {{"clearShare", numberText(clearShare)}}};
}

Warning partCountDiffers(uint32_t requested, uint32_t found) {
  const std::string text =
      requested < found ? fmt::format("the mesh has {} because a part does not extend over several components", found)
                        : fmt::format("the mesh can be divided into {} only", found);
  return {WarningCode::PartCountDiffers,
          fmt::format("{} requested; {}", counted(requested, "part"), text),
          {{"requested", std::to_string(requested)}, {"found", std::to_string(found)}}};
}

Warning skippedContent(const std::vector<std::string>& skipped) {
  return {WarningCode::SkippedContent,
          fmt::format("the mesh does not have everything that the file has: {}", joined(skipped, ", ")),
          {{"skipped", joined(skipped, ", ")}}};
}

Warning negativeVolumes(uint32_t count) {
  return {WarningCode::NegativeVolumes,
          fmt::format("{} of the file {} not subtracted: values there are those of the uncut bodies",
                      counted(count, "negative volume"), count == 1 ? "was" : "were"),
          {{"count", std::to_string(count)}}};
}

Warning coarseCoordinates(double step, double share) {
  return {
      WarningCode::CoarseCoordinates,
      fmt::format("the coordinates are float32 values far from the origin: they have steps of {:.3g}, {:.2g} % of "
                  "the size of the mesh, and thin walls are wrong; move the mesh to the origin before it is written",
                  step, 100 * share),
      {{"step", numberText(step)}}};
}

Warning uncertainParts(double agreement) {
  return {WarningCode::UncertainParts,
          fmt::format("the parts are uncertain: with other numbers of patches, the agreement of the parts is only "
                      "{:.2f} (1 means equal parts)",
                      agreement),
          {{"agreement", numberText(agreement)}}};
}

Warning coarseParts(double areaShare) {
  return {WarningCode::CoarseParts,
          fmt::format(
              "faces larger than half of the shape diameter have {:.0f} % of the area: boundaries of parts are coarse "
              "there, and parts may be missing",
              100 * areaShare),
          {{"areaShare", numberText(areaShare)}}};
}

Warning onlySmallComponents(double minShare, uint64_t partCount) {
  return {WarningCode::OnlySmallComponents,
          fmt::format("no component has {:g} % of the area, so each of the {} components is a part", 100 * minShare,
                      groupDigits(partCount)),
          {{"partCount", std::to_string(partCount)}}};
}

}  // namespace asdfvk
