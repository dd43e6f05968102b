#include "describe/report_json.h"

#include <utility>

#include "asdf_vk/version.h"
#include "describe/report_keys.h"

namespace asdfvk {

void to_json(Json& json, const Vec3d& point) { json = arrayOf(point); }
template <typename Enumeration>
requires requires(Enumeration value) { choicesOf(value); }
void to_json(Json& json, Enumeration value) { json = nameOf(choicesOf(value), value); }
void to_json(Json& json, const StageSeconds& seconds) {
  for (size_t i = 0; i < kStageCount; ++i) json[nameOf(static_cast<Stage>(i))] = seconds.seconds[i];
}
void to_json(Json& json, const std::vector<ErrorDetail>& details) {
  json = Json::object();
  for (const ErrorDetail& detail : details) json[detail.name] = detail.value;
}
template <typename Structure>
void putKeys(Json& json, const Structure& value) {
  visitKeys(value, [&](const std::string& key, const auto& member) { json[key] = member; });
}
template <typename Structure>
requires requires(const Structure& value) { structureName(value); }
void to_json(Json& json, const Structure& value) { putKeys(json, value); }

namespace {

ReportedField reportedField(const Field& field) {
  constexpr const char* kTypes[]{"float64", "uint8", "uint32"};
  const FieldSummary summary = summarize(field);
  return {field.name,
          field.unit,
          field.location == FieldLocation::PerFace ? "face" : "vertex",
          field.componentCount,
          kTypes[field.values.index()],
          summary.min,
          summary.median,
          summary.max,
          summary.missingCount};
}

}  // namespace

void to_json(Json& json, const TraceVariant& variant) { putKeys(json, variant); }

Json toJson(const OptionValue& value) {
  return std::visit(
      [](const auto& v) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>)
          return nullptr;
        else
          return v;
      },
      value);
}

Json toJson(const Report& report) { return report; }

Json optionValues(const ComputationSettings& computation, const SessionSettings& session) {
  Json json = Json::object();
  for (const auto& [key, value] : reportedOptions(computation, session)) json[key] = toJson(value);
  return json;
}

Json resultJson(const Report& report, std::span<const Field> fields, const ComputationSettings& computation,
                const SessionSettings& session) {
  Json json = toJson(report);
  ResultFacts facts{.version = ASDFVK_VERSION, .commit = ASDFVK_COMMIT, .options = optionValues(computation, session)};
  for (const Field& field : fields) facts.fields.push_back(reportedField(field));
  json.update(Json(facts));
  return json;
}

}  // namespace asdfvk
