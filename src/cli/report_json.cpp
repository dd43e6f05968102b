#include "cli/report.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "asdf_vk/version.h"
#include "core/json.h"

namespace asdfvk {
namespace {

std::string oneLineOf(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Json variantOf(const std::optional<TraceVariant>& variant) {
  if (!variant) return nullptr;
  return {{"kernel", variant->kernel}, {"bvh", variant->bvh}, {"fetch", variant->fetch}};
}

/// {"name": "sdf", "unit": "length", "per": "face", "components": 1, "type": "float64", "min": ...}
Json fieldOf(const Field& field) {
  constexpr const char* kTypes[]{"float64", "uint8", "uint32"};
  const FieldSummary summary = summarize(field);
  return {{"name", field.name},
          {"unit", field.unit},
          {"per", field.location == FieldLocation::PerFace ? "face" : "vertex"},
          {"components", field.componentCount},
          {"type", kTypes[field.values.index()]},
          {"min", number(summary.min)},
          {"median", number(summary.median)},
          {"max", number(summary.max)},
          {"missingCount", summary.missingCount}};
}

Json estimateOf(const std::optional<ErrorEstimate>& estimate) {
  if (!estimate) return nullptr;
  Json worst = Json::array();
  for (const ErrorEstimate::WorstFace& face : estimate->worstFaces)
    worst.push_back({{"face", face.face}, {"error", number(face.error)}});
  return {{"average", number(estimate->average)},
          {"standardError", number(estimate->standardError)},
          {"robustAverage", number(estimate->robustAverage)},
          {"relativeMedian", number(estimate->relativeMedian)},
          {"relativeMedianStandardError", number(estimate->relativeMedianStandardError)},
          {"relativePercentile90", number(estimate->relativePercentile90)},
          {"heldOutCount", estimate->heldOutCount},
          {"worstFaces", std::move(worst)}};
}

Json postprocessOf(const std::optional<PostprocessReport>& postprocess) {
  if (!postprocess) return nullptr;
  return {{"min", number(postprocess->min)}, {"max", number(postprocess->max)}};
}

Json partsOf(const std::optional<SegmentationReport>& segmentation) {
  if (!segmentation || !segmentation->parts) return nullptr;
  const PartsReport& parts = *segmentation->parts;
  return {{"fewestCount", parts.fewestCount},
          {"mostCount", parts.mostCount},
          {"agreement", parts.agreement ? number(*parts.agreement) : Json(nullptr)},
          {"thinShell", parts.isThinShell},
          {"areaShares", parts.areaShares}};
}

Json pointOf(const Vec3d& point) { return {number(point.x), number(point.y), number(point.z)}; }

Json regionsOf(const ThicknessReport& thickness) {
  if (!thickness.thinnerThan) return nullptr;
  Json regions = Json::array();
  for (const ThinRegion& region : thickness.thinRegions)
    regions.push_back({{"isSharp", region.isSharp},
                       {"min", number(region.min)},
                       {"minFace", region.minFace},
                       {"place", pointOf(region.place)},
                       {"opposite", pointOf(region.opposite)},
                       {"faceCount", region.faceCount},
                       {"area", number(region.area)},
                       {"areaShare", number(region.areaShare)}});
  return regions;
}

Json sharpEdgesOf(const ThicknessReport& thickness) {
  Json edges = Json::array();
  for (const SharpEdge& edge : thickness.sharpEdges)
    edges.push_back({{"angleDegrees", number(edge.angleDegrees)},
                     {"length", number(edge.length)},
                     {"edgeCount", edge.edgeCount},
                     {"place", pointOf(edge.place)},
                     {"face", edge.face}});
  return edges;
}

Json thicknessOf(const std::optional<ThicknessReport>& thickness) {
  if (!thickness) return nullptr;
  const auto ofMin = [&](Json value) { return std::isnan(thickness->min) ? Json(nullptr) : std::move(value); };
  const auto ofLimit = [&](Json value) { return thickness->thinnerThan ? std::move(value) : Json(nullptr); };
  const UnjudgedFaces& unjudged = thickness->unjudged;
  const auto& ball = thickness->greatestSection;
  return {{"verdict", thickness->verdict ? Json(nameOf(*thickness->verdict)) : Json(nullptr)},
          {"min", number(thickness->min)},
          {"minFace", ofMin(thickness->minFace)},
          {"minPlace", ofMin(pointOf(thickness->minPlace))},
          {"minOpposite", ofMin(pointOf(thickness->minOpposite))},
          {"percentile1", number(thickness->percentile1)},
          {"percentile5", number(thickness->percentile5)},
          {"median", number(thickness->median)},
          {"percentile95", number(thickness->percentile95)},
          {"max", number(thickness->max)},
          {"noValueCount", thickness->noValueCount},
          {"unjudged",
           {{"openCount", unjudged.openCount},
            {"invertedCount", unjudged.invertedCount},
            {"degenerateCount", unjudged.degenerateCount},
            {"crossedCount", unjudged.crossedCount},
            {"selfCrossedCount", unjudged.selfCrossedCount}}},
          {"greatestSection",
           ball ? Json{{"diameter", number(ball->diameter)}, {"centre", pointOf(ball->centre)}} : Json(nullptr)},
          {"sharpEdges", sharpEdgesOf(*thickness)},
          {"thinArea", ofLimit(number(thickness->thinArea))},
          {"thinAreaShare", ofLimit(number(thickness->thinAreaShare))},
          {"regions", regionsOf(*thickness)}};
}

Json stagesOf(const StageSeconds& seconds) {
  Json json;
  for (size_t i = 0; i < kStageCount; ++i) json[nameOf(static_cast<Stage>(i))] = number(seconds.seconds[i]);
  return json;
}

Json defectsOf(const MeshDefects& defects) {
  return {{"zeroAreaFaceCount", defects.zeroAreaFaceCount},
          {"duplicateFaceCount", defects.duplicateFaceCount},
          {"nonFiniteVertexCount", defects.nonFiniteVertexCount},
          {"nonFiniteFaceCount", defects.nonFiniteFaceCount},
          {"boundaryEdgeCount", defects.boundaryEdgeCount},
          {"nonManifoldEdgeCount", defects.nonManifoldEdgeCount},
          {"inconsistentEdgeCount", defects.inconsistentEdgeCount},
          {"unreferencedVertexCount", defects.unreferencedVertexCount},
          {"shortPolygonCount", defects.shortPolygonCount}};
}

Json checkOf(const std::optional<CheckReport>& check) {
  if (!check) return nullptr;
  return {{"passed", check->isIndependent ? Json(check->passed) : Json(nullptr)},
          {"independent", check->isIndependent},
          {"tracedCount", check->tracedCount},
          {"agreeingCount", check->agreeingCount},
          {"noValueAgreeCount", check->noValueAgreeCount},
          {"medianDifference", number(check->medianDifference)},
          {"worstDifference", number(check->worstDifference)},
          {"worstFace", check->worstFace},
          {"comparedCount", check->comparedCount},
          {"averageError", number(check->averageError)},
          {"maximumError", number(check->maximumError)},
          {"interpolatedCount", check->interpolatedCount},
          {"interpolatedAverageError", number(check->interpolatedAverageError)},
          {"interpolatedMaximumError", number(check->interpolatedMaximumError)}};
}

}  // namespace

std::string jsonReport(const MeshOutcome& outcome) {
  const Report& report = outcome.result.report;
  Json json;
  json["mesh"] = outcome.mesh;
  json["output"] = outcome.output;
  json["picture"] = outcome.outputs.picture.empty() ? Json(nullptr) : Json(outcome.outputs.picture);
  json["points"] = outcome.outputs.points.empty() ? Json(nullptr) : Json(outcome.outputs.points);
  json["faceCount"] = report.faceCount;
  json["triangleCount"] = report.triangleCount;
  json["vertexCount"] = report.vertexCount;
  json["componentCount"] = report.componentCount;
  json["size"] = pointOf(report.size);
  json["seedCount"] = report.seedCount;
  json["rayCount"] = report.rayCount;
  json["redoneConeCount"] = report.redoneConeCount;
  json["noValueCount"] = report.noValueCount;
  json["clampedCount"] = report.clampedCount;
  json["randomSeed"] = report.randomSeed;
  json["backend"] = report.backend;
  json["device"] = report.device;
  json["traceChoice"] = variantOf(report.traceVariant);
  json["stageSeconds"] = stagesOf(report.stageSeconds);
  json["raysPerSecond"] = number(report.raysPerSecond);
  json["traceDeviceSeconds"] = report.traceDeviceSeconds ? number(*report.traceDeviceSeconds) : Json(nullptr);
  json["solver"] = {{"name", report.solver.name},
                    {"iterations", report.solver.iterations},
                    {"relativeResidual", number(report.solver.relativeResidual)},
                    {"converged", report.solver.converged},
                    {"finishedOnCpu", report.solver.finishedOnCpu}};
  json["sdf"] = {{"min", number(report.sdf.min)},
                 {"percentile1", number(report.sdf.percentile1)},
                 {"median", number(report.sdf.median)},
                 {"percentile99", number(report.sdf.percentile99)},
                 {"max", number(report.sdf.max)}};
  json["postprocess"] = postprocessOf(report.postprocess);
  json["segmentCount"] = report.segmentation ? Json(report.segmentation->segmentCount) : Json(nullptr);
  json["parts"] = partsOf(report.segmentation);
  json["thickness"] = thicknessOf(report.thickness);
  json["estimatedError"] = estimateOf(report.estimatedError);
  json["roundCount"] = report.roundCount;
  json["check"] = checkOf(report.check);
  json["defects"] = defectsOf(report.defects);
  json["warnings"] = Json::array();
  json["warningCodes"] = Json::array();
  for (const Warning& warning : report.warnings) {
    json["warnings"].push_back(textWarning(warning));
    json["warningCodes"].push_back(nameOf(warning.code));
  }
  json["reversedFaceCount"] = report.reversedFaces.size();
  json["fields"] = Json::array();
  for (const Field& field : outcome.result.fields) json["fields"].push_back(fieldOf(field));
  json["version"] = ASDFVK_VERSION;
  json["commit"] = ASDFVK_COMMIT;
  json["options"] = optionValues(outcome.computation, outcome.session);
  return oneLineOf(json);
}

std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message) {
  Json json;
  json["mesh"] = mesh;
  json["error"] = message;
  json["code"] = code;
  return oneLineOf(json);
}

std::string jsonSkipped(const std::string& mesh, const MeshRecord& record) {
  Json json;
  json["mesh"] = mesh;
  json["output"] = record.output ? Json(*record.output) : Json(nullptr);
  json["status"] = nameOf(record.status);
  json["record"] = toJson(record);
  return oneLineOf(json);
}

std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason) {
  Json list = Json::array();
  for (size_t i = 0; i < devices.size(); ++i)
    list.push_back({{"index", i},
                    {"name", devices[i].name},
                    {"driver", devices[i].driver},
                    {"kind", devices[i].kind},
                    {"usable", devices[i].usable},
                    {"reason", devices[i].reason}});
  Json json;
  json["devices"] = std::move(list);
  json["reason"] = reason;
  return oneLineOf(json);
}

}  // namespace asdfvk
