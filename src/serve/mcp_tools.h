#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.h"
#include "serve/mesh_request.h"

/// The tools of `asdf-vk mcp` (docs/mcp.md).
namespace asdfvk {

struct McpTool {
  const char* name;
  const char* title;
  const char* description;
  std::vector<const char*> options;    ///< Names of rows of computationRows().
  std::vector<const char*> arguments;  ///< Further arguments: "with", "former", "output", "of", "view".
  std::vector<const char*> results;    ///< Keys of the JSON report that the tool describes.
  Json fixedOptions = Json::object();  ///< Options that the tool always sets.
  bool needsOption = false;            ///< Whether one of the options must be given.
};

[[nodiscard]] const std::vector<McpTool>& mcpTools();
/// Null if there is no such tool.
[[nodiscard]] const McpTool* findMcpTool(std::string_view name);

/// An element of the answer to "tools/list".
[[nodiscard]] Json descriptionOf(const McpTool& tool);

/// The request for a call of the tool. Throws Error of kind Usage for invalid arguments.
[[nodiscard]] MeshRequest requestOf(const McpTool& tool, const Json& arguments);

/// The result of a call: texts with the verdict first, a picture, and the JSON report as structured content.
/// repeatsReport: the texts include the JSON report, for clients that know no structured content.
[[nodiscard]] Json toolResultOf(const MeshAnswer& answer, bool repeatsReport);
/// The result of a call that failed.
[[nodiscard]] Json toolErrorOf(const RequestFailure& failure);

}  // namespace asdfvk
