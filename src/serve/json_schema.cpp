#include "serve/json_schema.h"

namespace asdfvk {
namespace {

constexpr std::string_view kPartsPrefix = "#/$defs/";

}  // namespace

std::vector<std::string> schemaNames() {
  std::vector<std::string> names;
  for (const SchemaDocument& document : kSchemaDocuments) names.emplace_back(document.name);
  names.emplace_back(kAllDocuments);
  return names;
}

const Json& schemaDefinitions() {
  static const Json definitions = Json::parse(schemaText()).at("$defs");
  return definitions;
}

Json schemaReference(std::string_view name) { return {{"$ref", std::string(kPartsPrefix) + std::string(name)}}; }

std::string referencedPart(const Json& schema) {
  return schema.at("$ref").get_ref<const std::string&>().substr(kPartsPrefix.size());
}

void addReferencedParts(const Json& schema, Json& parts) {
  for (const auto& [key, value] : schema.items()) {
    if (key == "$ref" && value.is_string()) {
      const std::string name = referencedPart(schema);
      if (parts.contains(name)) continue;
      const Json& part = parts[name] = schemaDefinitions().at(name);
      addReferencedParts(Json(part), parts);
    } else if (value.is_structured()) {
      addReferencedParts(value, parts);
    }
  }
}

std::string documentSchema(const std::string& name) {
  if (name == kAllDocuments) return std::string(schemaText());
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}}, parts = Json::object();
  schema.update(schemaDefinitions().at(name));
  addReferencedParts(schema, parts);
  schema["$defs"] = std::move(parts);
  return jsonText(schema, 1) + "\n";
}

}  // namespace asdfvk
