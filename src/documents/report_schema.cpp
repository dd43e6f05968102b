// The JSON Schema of what `asdf-vk --json` prints.
#include <algorithm>
#include <string_view>

#include "asdf_vk/version.h"
#include "core/json.h"
#include "describe/report_json.h"
#include "documents/documents.h"

namespace asdfvk {
namespace {

Json reference(std::string_view name) { return {{"$ref", "#/$defs/" + std::string(name)}}; }
Json orNull(Json schema) { return {{"anyOf", {std::move(schema), {{"type", "null"}}}}}; }

/// The schema of a type of Python, such as "tuple[ThinRegion, ...]" or "float | None".
Json schemaOf(std::string_view type) {
  constexpr std::string_view kOptional = " | None", kListBegin = "tuple[", kListEnd = ", ...]";
  if (type.ends_with(kOptional)) return orNull(schemaOf(type.substr(0, type.size() - kOptional.size())));
  if (type.starts_with(kListBegin)) {
    type.remove_prefix(kListBegin.size());
    return {{"type", "array"}, {"items", schemaOf(type.substr(0, type.size() - kListEnd.size()))}};
  }
  if (type == "bool") return {{"type", "boolean"}};
  if (type == "int") return {{"type", "integer"}, {"minimum", 0}};
  if (type == "float") return {{"type", {"number", "null"}}};  // Numbers that are not finite are null.
  if (type == "str") return {{"type", "string"}};
  if (type == "dict[str, float]") return {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}};
  if (type == "dict[str, str]") return {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}};
  return reference(type);
}

/// Objects are open, because later versions have more keys.
Json objectOf(const std::string& comment, Json properties) {
  Json required = Json::array();
  for (const auto& [key, value] : properties.items()) required.push_back(key);
  Json object{{"type", "object"}};
  if (!comment.empty()) object["description"] = comment;
  object["properties"] = std::move(properties);
  object["required"] = std::move(required);
  return object;
}

Json propertiesOf(const ReportStructure& structure) {
  Json properties = Json::object();
  for (const ReportMember& member : structure.members) {
    Json schema = schemaOf(member.pythonType);
    schema["description"] = member.comment;
    properties[member.name] = std::move(schema);
  }
  return properties;
}

Json definitionsOf(const ReportModel& model) {
  const Json number{{"type", {"number", "null"}}}, text{{"type", "string"}};
  Json all{{"Point", {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}}}};
  for (const ReportEnumeration& row : model.enumerations)
    if (row.name != "Stage") all[row.name] = {{"enum", row.names}};
  for (const ReportStructure& structure : model.structures)
    all[structure.name] = objectOf(structure.comment, propertiesOf(structure));
  all["FieldSummary"] = objectOf("A field of the result.", {{"name", text},
                                                            {"unit", {{"enum", {"", "length"}}}},
                                                            {"per", {{"enum", {"face", "vertex"}}}},
                                                            {"components", {{"type", "integer"}}},
                                                            {"type", {{"enum", {"float64", "uint8", "uint32"}}}},
                                                            {"min", number},
                                                            {"median", number},
                                                            {"max", number},
                                                            {"missingCount", {{"type", "integer"}}}});
  return all;
}

/// What is said about a mesh beside its report.
Json meshProperties() {
  const Json text{{"type", "string"}}, path = orNull(text);
  return {{"formatVersion", {{"const", kReportFormatVersion}}},
          {"mesh", text},
          {"output", path},
          {"picture", path},
          {"points", path},
          {"with", {{"type", "array"}, {"items", text}}},
          {"withFaceCounts", {{"type", "array"}, {"items", {{"type", "integer"}}}}},
          {"former", path},
          {"fields", {{"type", "array"}, {"items", reference("FieldSummary")}}},
          {"version", text},
          {"commit", text},
          {"options", {{"type", "object"}}}};
}

/// Adds to each property the version of the program that had it first: `earlier` has those of older properties.
void addVersions(Json& schema, const Json& earlier) {
  if (!schema.contains("properties")) return;
  const Json known = earlier.value("properties", Json::object());
  for (auto& [key, property] : schema["properties"].items()) {
    const Json old = known.value(key, Json::object());
    property["x-since"] = old.value("x-since", Json(ASDFVK_VERSION));
  }
}

}  // namespace

std::string reportSchema(const ReportModel& model, const std::string& earlier) {
  const Json old = Json::parse(earlier, nullptr, false);
  const Json text{{"type", "string"}};
  Json definitions = definitionsOf(model);
  definitions["Result"] = {{"description", "A computed mesh: its report, and these keys."},
                           {"allOf", {reference("Report"), objectOf("", meshProperties())}}};
  definitions["Failure"] = objectOf(
      "A mesh without a result, or an invalid command line.",
      {{"formatVersion", {{"const", kReportFormatVersion}}}, {"mesh", orNull(text)}, {"error", text}, {"code", text}});
  definitions["Skipped"] =
      objectOf("A mesh that --skip-existing skipped.", {{"formatVersion", {{"const", kReportFormatVersion}}},
                                                        {"mesh", text},
                                                        {"output", orNull(text)},
                                                        {"status", {{"const", "skipped"}}},
                                                        {"record", {{"type", "object"}}}});
  const Json oldDefinitions = old.is_object() ? old.value("$defs", Json::object()) : Json::object();
  for (auto& [name, schema] : definitions.items()) addVersions(schema, oldDefinitions.value(name, Json::object()));
  return jsonText(
             {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "What asdf-vk --json prints: a document per line"},
              {"description",
               "Keys are stable: within a major version of the program, keys are added and none is removed. x-since "
               "is the version that had a key first."},
              {"oneOf", {reference("Result"), reference("Failure"), reference("Skipped")}},
              {"$defs", std::move(definitions)}},
             1) +
         "\n";
}

}  // namespace asdfvk
