#pragma once

#include <string>
#include <string_view>

#include "batch/mesh_record.h"
#include "cli/mesh_outcome.h"

namespace asdfvk {

/// docs/report.schema.json: the JSON Schema of the following documents.
[[nodiscard]] std::string_view reportSchemaText();

/// One line of JSON with the keys of docs/formats.md.
[[nodiscard]] std::string jsonReport(const MeshOutcome& outcome);

/// One line with the keys "mesh", "error" and "code". An empty mesh becomes null: the command line is invalid.
[[nodiscard]] std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message);

/// One line with the keys "mesh", "output", "status" and "record", for a mesh that --skip-existing skips.
[[nodiscard]] std::string jsonSkipped(const std::string& mesh, const MeshRecord& record);

}  // namespace asdfvk
