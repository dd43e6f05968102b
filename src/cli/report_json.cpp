#include "cli/report_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/option_values.h"

namespace asdfvk {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string oneLineOf(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

const char* nameOf(SolverChoice solver) {
  switch (solver) {
    case SolverChoice::Cg:
      return "cg";
    case SolverChoice::Jacobi:
      return "jacobi";
    case SolverChoice::Eigen:
      return "eigen";
    case SolverChoice::Auto:
      break;
  }
  return "auto";
}

const char* nameOf(Orientation orientation) {
  switch (orientation) {
    case Orientation::Auto:
      return "auto";
    case Orientation::Flip:
      return "flip";
    case Orientation::Keep:
      break;
  }
  return "keep";
}

const char* nameOf(Backend backend) {
  switch (backend) {
    case Backend::Vulkan:
      return "vulkan";
    case Backend::Cpu:
      return "cpu";
    case Backend::Reference:
      return "reference";
    case Backend::Auto:
      break;
  }
  return "auto";
}

Json optionsOf(const CommandLine& line) {
  const Options& options = line.options;
  return {{"seeds", toText(options.seeds)},
          {"rays", options.cone.rayCount},
          {"angleDegrees", options.cone.openingAngleDegrees},
          {"falseHitAngleDegrees", options.cone.falseHitAngleDegrees},
          {"outlierDeviations", options.cone.outlierDeviations},
          {"orient", nameOf(options.orientation)},
          {"solver", nameOf(options.solver)},
          {"guidance", options.guidance},
          {"tolerance", options.solverOptions.tolerance},
          {"maxIterations", options.solverOptions.maxIterations},
          {"backend", nameOf(line.session.backend)},
          {"device", line.session.device},
          {"requireGpu", line.session.requireGpu}};
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
  const Report& report = outcome.report;
  const StageSeconds& seconds = report.stageSeconds;
  Json json;
  json["mesh"] = outcome.mesh;
  json["output"] = outcome.output;
  json["faceCount"] = report.faceCount;
  json["triangleCount"] = report.triangleCount;
  json["vertexCount"] = report.vertexCount;
  json["componentCount"] = report.componentCount;
  json["seedCount"] = report.seedCount;
  json["rayCount"] = report.rayCount;
  json["redoneConeCount"] = report.redoneConeCount;
  json["noValueCount"] = report.noValueCount;
  json["randomSeed"] = report.randomSeed;
  json["backend"] = report.backend;
  json["device"] = report.device;
  json["stageSeconds"] = {{"read", number(seconds.read)},   {"geometry", number(seconds.geometry)},
                          {"bvh", number(seconds.bvh)},     {"upload", number(seconds.upload)},
                          {"trace", number(seconds.trace)}, {"solve", number(seconds.solve)},
                          {"write", number(seconds.write)}};
  json["raysPerSecond"] = number(report.raysPerSecond);
  json["solver"] = {{"name", report.solver.name},
                    {"iterations", report.solver.iterations},
                    {"relativeResidual", number(report.solver.relativeResidual)},
                    {"converged", report.solver.converged}};
  json["sdf"] = {
      {"min", number(report.sdf.min)}, {"median", number(report.sdf.median)}, {"max", number(report.sdf.max)}};
  json["check"] = checkOf(report.check);
  json["defects"] = defectsOf(report.defects);
  json["warnings"] = report.warnings;
  json["options"] = optionsOf(outcome.line);
  return oneLineOf(json);
}

std::string jsonFailure(const std::string& mesh, const std::string& message) {
  Json json;
  json["mesh"] = mesh;
  json["error"] = message;
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
