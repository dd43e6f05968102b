#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.h"

/// JSON Schema (draft 2020-12) of the JSON documents that the program writes and reads.
namespace asdfvk {

struct SchemaDocument {
  const char* name;
  const char* title;
};
inline constexpr std::array kSchemaDocuments{
    SchemaDocument{"report", "What asdf-vk --json prints: a document per mesh"},
    SchemaDocument{"record", "A line of --log, and the file beside a result of a batch"},
    SchemaDocument{"summary", "What asdf-vk summarize --format json prints"},
    SchemaDocument{"request", "A line that asdf-vk serve reads"},
    SchemaDocument{"answer", "A line that asdf-vk serve writes"},
    SchemaDocument{"devices", "What asdf-vk --list-devices --json prints"},
    SchemaDocument{"device-report", "What asdf-vk --device-report prints"},
    SchemaDocument{"limits", "The file of --limits"},
    SchemaDocument{"baseline", "The file of --baseline"},
};
/// The schema of all documents.
inline constexpr const char* kAllDocuments = "all";

/// The names of kSchemaDocuments, and kAllDocuments.
[[nodiscard]] std::vector<std::string> schemaNames();

/// docs/schema.json: "$defs" has the documents by their names, and their parts.
[[nodiscard]] std::string_view schemaText();
[[nodiscard]] const Json& schemaDefinitions();

/// Reference to a part of schemaDefinitions().
[[nodiscard]] Json schemaReference(std::string_view name);
/// The part to which a schema with the key $ref refers.
[[nodiscard]] std::string referencedPart(const Json& schema);

/// Adds to `parts` all parts that `schema` needs: those to which it refers, and those to which these parts refer.
void addReferencedParts(const Json& schema, Json& parts);

/// The schema of one document with the parts that it needs. name: one of schemaNames().
[[nodiscard]] std::string documentSchema(const std::string& name);

}  // namespace asdfvk
