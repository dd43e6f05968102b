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
  return {{"read", jsonOf(row.stage(&StageSeconds::read))},   {"geometry", jsonOf(row.stage(&StageSeconds::geometry))},
          {"bvh", jsonOf(row.stage(&StageSeconds::bvh))},     {"upload", jsonOf(row.stage(&StageSeconds::upload))},
          {"trace", jsonOf(row.stage(&StageSeconds::trace))}, {"solve", jsonOf(row.stage(&StageSeconds::solve))},
          {"write", jsonOf(row.stage(&StageSeconds::write))}};
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
  json["referenceOverVulkan"] = {{"traceAndSolve", jsonOf(referenceOverVulkan(measurement, row, Share::TraceAndSolve))},
                                 {"total", jsonOf(referenceOverVulkan(measurement, row, Share::Total))}};
  json["traceAndSolveOverFullTrace"] = jsonOf(overFullTrace(measurement, row));
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
