// The JSON Schema of the documents that the program writes and reads.
#include "serve/json_schema.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "asdf_vk/error.h"
#include "asdf_vk/version.h"
#include "cli/check_policy.h"
#include "cli/mesh_jobs.h"
#include "cli/request_line.h"
#include "describe/option_json.h"
#include "documents/documents.h"

namespace asdfvk {
namespace {

constexpr const char *kProperties = "properties", *kSince = "x-since", *kFormat = "x-formatVersion";

Json listOf(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

/// The schema of a type of Python, such as "tuple[ThinRegion, ...]" or "float | None".
Json schemaOf(std::string_view type) {
  constexpr std::string_view kOptional = " | None", kListBegin = "tuple[", kListEnd = ", ...]",
                             kObjectBegin = "dict[str, ";
  if (type.ends_with(kOptional)) return orNull(schemaOf(type.substr(0, type.size() - kOptional.size())));
  if (type.starts_with(kListBegin)) {
    type.remove_prefix(kListBegin.size());
    return listOf(schemaOf(type.substr(0, type.size() - kListEnd.size())));
  }
  if (type.starts_with(kObjectBegin)) {
    type.remove_prefix(kObjectBegin.size());
    return {{"type", "object"}, {"additionalProperties", schemaOf(type.substr(0, type.size() - 1))}};
  }
  if (type == "bool") return {{"type", "boolean"}};
  if (type == "int") return {{"type", "integer"}, {"minimum", 0}};
  if (type == "float") return {{"type", {"number", "null"}}};  // Numbers that are not finite are null.
  if (type == "str") return {{"type", "string"}};
  return schemaReference(type);
}

/// The schemas of members whose type in C++ is Json, or whose JSON is not that of their type.
const std::map<std::string, Json>& untypedMembers() {
  const Json any = Json::object(), options = schemaReference("Options");
  static const std::map<std::string, Json> members{
      {"ResultFacts.options", options},
      {"SkippedDocument.record", schemaReference("MeshRecord")},
      {"MeshRecord.error", orNull({{"type", "string"}})},
      {"MeshRecord.key", orNull({{"type", "string"}})},
      {"MeshRecord.sdf", orNull(schemaReference("ValueRange"))},
      {"MeshRecord.thickness", orNull(schemaReference("RecordThicknessReport"))},
      {"MeshRecord.parts", orNull(schemaReference("RecordPartsReport"))},
      {"MeshRecord.estimatedError", orNull(schemaReference("RecordErrorEstimate"))},
      {"MeshRecord.findings", orNull(listOf(schemaReference("Finding")))},
      {"MeshRecord.options", orNull(options)},
      {"ReportAnswer.id", any},
      {"ReportAnswer.report", schemaReference("Result")},
      {"ErrorAnswer.id", any},
      {"CancelAnswer.cancel", any},
  };
  return members;
}

Json memberSchema(const ReportStructure& structure, const ReportMember& member) {
  const auto untyped = untypedMembers().find(structure.name + "." + member.name);
  Json schema = untyped != untypedMembers().end() ? untyped->second
                : member.name == "formatVersion"  ? Json{{"const", kJsonFormatVersion}}
                                                  : schemaOf(member.pythonType);
  schema["description"] = member.comment;
  return schema;
}

/// Objects of output are open, because later versions have more keys.
Json objectOf(const ReportStructure& structure) {
  Json properties = Json::object(), required = Json::array();
  for (const ReportMember& member : structure.members) {
    properties[member.name] = memberSchema(structure, member);
    if (!member.isOptional) required.push_back(member.name);
  }
  return {{"description", structure.comment},
          {"type", "object"},
          {kProperties, std::move(properties)},
          {"required", std::move(required)}};
}

/// Adds the schema of an object of the report without the lists that records do not have.
void addRecordPart(const std::string& name, Json& all) {
  Json part = all.at(name), properties = Json::object(), required = Json::array();
  for (const auto& [key, property] : part[kProperties].items()) {
    Json schema = property;
    const bool isNullable = schema.contains("anyOf");
    Json& value = isNullable ? schema["anyOf"][0] : schema;
    const std::string target = value.contains("$ref") ? referencedPart(value) : "";
    if (!isKeptInRecord(key) && (value.value("type", Json()) == "array" || target == "Point")) continue;
    if (!target.empty() && all.at(target).contains(kProperties)) {
      addRecordPart(target, all);
      value["$ref"] = schemaReference("Record" + target)["$ref"];
    }
    properties[key] = std::move(schema);
    required.push_back(key);
  }
  part[kProperties] = std::move(properties);
  part["required"] = std::move(required);
  all["Record" + name] = std::move(part);
}

Json reportedOptionsSchema() {
  SettingsWithRows all;
  const OptionRows tables[]{all.ofComputation, all.ofSession};
  const Json accepted = optionsSchema(tables, OptionSpelling::CamelCase)[kProperties];
  Json options{{"description", "Options that affect the result. An option without effect is null."},
               {"type", "object"},
               {kProperties, Json::object()},
               {"required", Json::array()}};
  for (const auto& [name, value] : reportedOptions(all.computation, all.session)) {
    options[kProperties][name] = accepted.at(name);
    options["required"].push_back(name);
  }
  return options;
}

Json partsOf(const ReportModel& model) {
  const Json number{{"type", {"number", "null"}}};
  Json all{{"Point", {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}}}};
  for (const ReportEnumeration& row : model.enumerations)
    if (row.name != "Stage") all[row.name] = {{"enum", row.names}};
  for (const ReportStructure& structure : model.structures) all[structure.name] = objectOf(structure);
  Json result = all["Report"];
  result["description"] = "A computed mesh.";
  for (const char* const name : {"ReportFiles", "ResultFacts"}) {
    result[kProperties].update(all[name][kProperties]);
    for (const Json& key : all[name]["required"]) result["required"].push_back(key);
    all.erase(name);
  }
  all.erase("Report");
  all["Result"] = std::move(result);
  all["Options"] = reportedOptionsSchema();
  for (const char* const name : {"ThicknessReport", "PartsReport", "ErrorEstimate"}) addRecordPart(name, all);
  all.update(requestDefinitions());
  all.update(limitDefinitions());
  return all;
}

/// The parts that are the documents of kSchemaDocuments.
Json documentsOf() {
  const std::map<std::string, std::vector<const char*>> names{
      {"report", {"Result", "FailureDocument", "SkippedDocument"}},
      {"record", {"MeshRecord"}},
      {"summary", {"SummaryDocument"}},
      {"request", {"Request"}},
      {"answer", {"ReportAnswer", "ErrorAnswer", "CancelAnswer"}},
      {"devices", {"DeviceList"}},
      {"device-report", {"DeviceReportDocument"}},
      {"limits", {"LimitFile"}},
      {"baseline", {"BaselineDocument"}},
  };
  Json documents = Json::object();
  for (const auto& [name, title] : kSchemaDocuments) {
    Json document{{"title", title}}, alternatives = Json::array();
    for (const char* const part : names.at(name)) alternatives.push_back(schemaReference(part));
    if (alternatives.size() == 1)
      document.update(alternatives[0]);
    else
      document["oneOf"] = std::move(alternatives);
    documents[name] = std::move(document);
  }
  return documents;
}

/// The property without texts and ranges.
Json typeOf(Json property) {
  for (const char* const key :
       {"description", kSince, "enum", "minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "minLength"})
    property.erase(key);
  for (auto& [key, value] : property.items())
    if (value.is_structured()) value = typeOf(std::move(value));
  return property;
}

bool isRequired(const Json& part, const std::string& key) {
  const Json required = part.value("required", Json::array());
  return std::find(required.begin(), required.end(), key) != required.end();
}

/// Why users of a released version cannot read documents of `now`; empty: they can.
std::string changeOf(const std::string& name, const Json& old, const Json& now) {
  for (const Json& value : old.value("enum", Json::array())) {
    const Json values = now.value("enum", Json::array());
    if (old.value(kSince, ASDFVK_VERSION) != ASDFVK_VERSION &&
        std::find(values.begin(), values.end(), value) == values.end())
      return fmt::format("the value {} of {} is missing", jsonText(value), name);
  }
  const Json properties = now.value(kProperties, Json::object()), known = old.value(kProperties, Json::object());
  for (const auto& [key, property] : known.items()) {
    if (property.value(kSince, ASDFVK_VERSION) == ASDFVK_VERSION) continue;
    if (!properties.contains(key)) return fmt::format("the key {} of {} is missing", key, name);
    if (typeOf(properties[key]) != typeOf(property) || isRequired(now, key) != isRequired(old, key))
      return fmt::format("the key {} of {} has another type", key, name);
  }
  return {};
}

/// Adds the version of the program that had a key or a list of values first.
void addVersions(const Json& old, Json& now) {
  if (now.contains("enum")) now[kSince] = old.value(kSince, ASDFVK_VERSION);
  if (!now.contains(kProperties)) return;
  const Json known = old.value(kProperties, Json::object());
  for (auto& [key, property] : now[kProperties].items())
    property[kSince] = known.value(key, Json::object()).value(kSince, ASDFVK_VERSION);
}

}  // namespace

std::string jsonSchema(const ReportModel& model, const std::string& earlier) {
  Json old = Json::parse(earlier, nullptr, false);
  if (!old.is_object()) old = Json::object();
  const Json oldParts = old.value("$defs", Json::object());
  Json parts = documentsOf();
  parts.update(partsOf(model));
  for (const auto& [name, part] : oldParts.items()) {
    const std::string change = changeOf(name, part, parts.value(name, Json::object()));
    if (!change.empty() && old.value(kFormat, 0) == kJsonFormatVersion)
      throw Error(ErrorCode::ValueOutOfRange,
                  fmt::format("docs/schema.json: {}, but a released version has it; keep it, or increase "
                              "kJsonFormatVersion",
                              change));
  }
  for (auto& [name, part] : parts.items()) addVersions(oldParts.value(name, Json::object()), part);
  return jsonText({{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"title", "JSON documents of asdf-vk"},
                   {"description", "The documents are the first entries of $defs. docs/formats.md describes them."},
                   {kFormat, kJsonFormatVersion},
                   {"$defs", std::move(parts)}},
                  1) +
         "\n";
}

}  // namespace asdfvk
