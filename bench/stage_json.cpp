#include "stage_json.h"

#include <nlohmann/json.hpp>

namespace asdfvk::bench {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const Spread& spread) {
  return {{"median", spread.median}, {"deviation", spread.deviation}, {"min", spread.min}, {"max", spread.max}};
}

Json jsonOf(const std::optional<Spread>& spread) { return spread ? jsonOf(*spread) : Json(nullptr); }

Json stagesOf(const StageRow& row) {
  Json json;
  for (const auto& [name, member] : kStages) json[name] = jsonOf(row.stage(member));
  return json;
}

Json jsonOf(const StageMeasurement& measurement, const StageRow& row, const Machine& machine) {
  const Report& report = row.runs.front().report;
  Json json;
  json["mesh"] = measurement.mesh;
  json["faceCount"] = report.faceCount;
  json["triangleCount"] = report.triangleCount;
  json["vertexCount"] = report.vertexCount;
  json["seeds"] = row.seeds;
  json["seedCount"] = report.seedCount;
  json["rayCount"] = report.rayCount;
  json["backend"] = row.backend;
  json["device"] = report.device;
  json["processor"] = machine.processor;
  json["threads"] = machine.threads;
  json["loadAverage"] = machine.loadAverage;
  json["runs"] = row.runs.size();
  json["stageSeconds"] = stagesOf(row);
  json["totalSeconds"] = jsonOf(row.total());
  json["raysPerSecond"] = jsonOf(row.raysPerSecond());
  json["raysPerSecondAndCore"] = row.perCore ? Json(row.raysPerSecond().median / machine.threads) : Json(nullptr);
  json["coldSeconds"] = row.cold.seconds;
  json["peakBytes"] = row.cold.peakBytes;
  json["solver"] = {{"name", report.solver.name}, {"iterations", report.solver.iterations}};
  json["referenceOverVulkan"] = {
      {"traceAndInterpolation", jsonOf(referenceOverVulkan(measurement, row, Share::TraceAndInterpolation))},
      {"total", jsonOf(referenceOverVulkan(measurement, row, Share::Total))}};
  json["traceAndInterpolationOverFullTrace"] = jsonOf(overFullTrace(measurement, row));
  return json;
}

}  // namespace

std::string stageJson(const StageMeasurement& measurement, const Machine& machine) {
  std::string text;
  for (const StageRow& row : measurement.rows)
    text +=
        jsonOf(measurement, row, machine).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  return text;
}

}  // namespace asdfvk::bench
