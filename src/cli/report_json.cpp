#include "cli/report.h"

#include <type_traits>
#include <utility>

#include "asdf_vk/version.h"
#include "core/json.h"
#include "describe/report_keys.h"

namespace asdfvk {
namespace {

std::string oneLineOf(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
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

Json jsonOf(double value) { return number(value); }
Json jsonOf(const std::string& text) { return text; }
Json jsonOf(const Vec3d& point) { return arrayOf(point); }
Json jsonOf(WarningCode code) { return nameOf(code); }
Json jsonOf(ThicknessVerdict verdict) { return nameOf(verdict); }

Json jsonOf(const StageSeconds& seconds) {
  Json json;
  for (size_t i = 0; i < kStageCount; ++i) json[nameOf(static_cast<Stage>(i))] = number(seconds.seconds[i]);
  return json;
}

Json jsonOf(const std::vector<ErrorDetail>& details) {
  Json json = Json::object();
  for (const ErrorDetail& detail : details) json[detail.name] = detail.value;
  return json;
}

template <typename T>
Json jsonOf(const T& value);

template <typename T>
Json jsonOf(const std::optional<T>& value) {
  return value ? jsonOf(*value) : Json(nullptr);
}

template <typename T>
Json jsonOf(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(jsonOf(item));
  return list;
}

/// Numbers and flags, and an object of the members of a structure of the report.
template <typename T>
Json jsonOf(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    return value;
  } else {
    Json json = Json::object();
    visitKeys(value, [&](const char* key, const auto& member) { json[key] = jsonOf(member); });
    return json;
  }
}

}  // namespace

std::string jsonReport(const MeshOutcome& outcome) {
  Json json;
  json["mesh"] = outcome.mesh;
  json["output"] = outcome.output;
  json["picture"] = outcome.outputs.picture.empty() ? Json(nullptr) : Json(outcome.outputs.picture);
  json["points"] = outcome.outputs.points.empty() ? Json(nullptr) : Json(outcome.outputs.points);
  Report report = outcome.result.report;
  for (Warning& warning : report.warnings) warning.message = textWarning(warning);
  json.update(jsonOf(report));
  json["fields"] = Json::array();
  for (const Field& field : outcome.result.fields) json["fields"].push_back(fieldOf(field));
  json["version"] = ASDFVK_VERSION;
  json["commit"] = ASDFVK_COMMIT;
  json["options"] = optionValues(outcome.computation, outcome.session);
  return oneLineOf(json);
}

Json toJson(const ErrorEstimate& estimate) { return jsonOf(estimate); }

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
