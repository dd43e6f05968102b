#include "serve/mcp_tools.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "describe/computation_options.h"
#include "describe/option_json.h"
#include "serve/json_schema.h"

namespace asdfvk {
namespace {

/// An argument of tools that is neither an option of computations nor a key of requests.
struct ToolArgument {
  const char* name;
  Json schema;
};

const std::vector<ToolArgument>& toolArguments() {
  static const std::vector<ToolArgument> arguments{
      {"output",
       {{"type", "string"},
        {"description",
         "Path of a new file for the values: .ply, .vtu, .glb, .obj, .npy, .npz, .csv or .html. Files other than "
         "NAME.asdf.EXTENSION are not overwritten"}}},
      {"of",
       {{"type", "string"},
        {"description", "Field that the picture shows, such as thickness, sdf or segment; default: the thin places"}}},
      {"view",
       {{"type", "string"},
        {"description", "Azimuth and elevation of the camera in degrees, such as 30,18; default: chosen"}}},
  };
  return arguments;
}

const Json& schemaOf(std::string_view argument) {
  const auto& all = toolArguments();
  const auto own = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.name == argument; });
  return own != all.end() ? own->schema : schemaOfKey(argument);
}

/// The schema without references and texts. depth: objects that are nested deeper have no properties, because clients
/// send the list of the tools to a model.
Json briefSchema(const Json& schema, int depth) {
  if (schema.contains("$ref")) return briefSchema(schemaDefinitions().at(referencedPart(schema)), depth);
  Json brief = Json::object();
  for (const char* const key : {"type", "enum"})
    if (schema.contains(key)) brief[key] = schema[key];
  if (schema.contains("items")) brief["items"] = briefSchema(schema["items"], depth);
  if (schema.contains("properties") && depth > 0)
    for (const auto& [key, property] : schema["properties"].items())
      brief["properties"][key] = briefSchema(property, depth - 1);
  for (const Json& alternative : schema.value("anyOf", Json::array()))
    brief["anyOf"].push_back(briefSchema(alternative, depth));
  return brief;
}

/// The keys of the structured content on which a client can rely.
Json outputSchemaOf(const McpTool& tool) {
  const Json& report = schemaDefinitions().at("Result").at("properties");
  Json properties = Json::object(), required = Json::array();
  for (const char* const key : tool.results) {
    properties[key] = briefSchema(report.at(key), 1);
    required.push_back(key);
  }
  properties["error"] = briefSchema(schemaReference("RequestFailure"), 1);
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"anyOf", {{{"required", std::move(required)}}, {{"required", {"error"}}}}}};
}

std::string jsonName(const OptionRows& rows, const char* option) {
  return spelled(*findOption(rows, option), OptionSpelling::CamelCase);
}

Json textContent(std::string text) { return {{"type", "text"}, {"text", std::move(text)}}; }

/// The verdict or the size of the mesh, then the other rows.
std::string textOf(const MeshAnswer& answer) {
  std::string text;
  for (const auto& [title, row] : answer.rows) {
    if (text.empty())
      text = row;
    else
      text += fmt::format("\n{}{}{}", title, title.empty() ? "" : ": ", row);
  }
  if (answer.failure && text.find(answer.failure->message) == std::string::npos) text += "\n" + answer.failure->message;
  return text;
}

}  // namespace

const std::vector<McpTool>& mcpTools() {
  static const std::vector<McpTool> tools{
      {.name = "check_walls",
       .title = "Check walls and gaps",
       .description =
           "Checks whether every wall of a part is at least as thick as a limit, and every gap at least as wide, for "
           "printing or moulding. Judges all points of the surface, not samples. Returns a verdict (PASS, FAIL, or not "
           "judged, for example for an open mesh), and for each place that fails its value, position, face and a "
           "remedy.",
       .options = {"thinner-than", "closer-than", "thicker-than", "fail-if-voids", "fail-if-contact", "count-edges",
                   "count-details", "next-wall", "wall-angle"},
       .arguments = {"with", "former"},
       .results = {"unit", "thickness", "gap", "findings"},
       .needsOption = true},
      {.name = "measure",
       .title = "Measure thickness or diameters",
       .description =
           "Measures the local thickness of a mesh: the wall thickness (exact, measure=thickness), the widths of gaps, "
           "or the shape diameter (by rays, measure=sdf). Returns least, median and greatest values. With output, "
           "writes a value per face.",
       .options = {"measure", "seeds", "max-error", "recipe", "definition", "orient", "per"},
       .arguments = {"output"},
       .results = {"unit", "size", "sdf", "thickness", "gap", "estimatedError"}},
      {.name = "find_parts",
       .title = "Find the parts of a shape",
       .description = "Divides a shape into parts such as limbs and handles, by its shape diameter. Returns the number "
                      "and the sizes of the parts. With output, writes a part number per face.",
       .options = {"parts", "detail", "orient"},
       .arguments = {"output"},
       .results = {"segmentCount", "parts"},
       .fixedOptions = {{"segment", "parts"}}},
      {.name = "picture",
       .title = "Picture of a mesh",
       .description =
           "Draws a mesh as PNG. With thinnerThan, thin places are red and have labels with their thickness; "
           "else the colours show a field.",
       .options = {"thinner-than", "closer-than", "measure", "segment", "count-edges", "count-details", "orient"},
       .arguments = {"of", "view"},
       .results = {"faceCount", "size"}},
  };
  return tools;
}

const McpTool* findMcpTool(std::string_view name) {
  const auto& tools = mcpTools();
  const auto found = std::find_if(tools.begin(), tools.end(), [&](const McpTool& tool) { return tool.name == name; });
  return found == tools.end() ? nullptr : &*found;
}

Json descriptionOf(const McpTool& tool) {
  ComputationSettings settings;
  const OptionRows rows = computationRows(settings);
  Json properties{{"mesh", schemaOf("mesh")}};
  for (const char* const option : tool.options)
    properties[jsonName(rows, option)] = optionSchema(*findOption(rows, option), rows);
  for (const char* const argument : tool.arguments) properties[argument] = schemaOf(argument);
  const bool writes = std::any_of(tool.arguments.begin(), tool.arguments.end(),
                                  [](std::string_view argument) { return argument == "output"; });
  return {{"name", tool.name},
          {"title", tool.title},
          {"description", tool.description},
          {"inputSchema",
           {{"type", "object"},
            {"properties", std::move(properties)},
            {"required", Json::array({"mesh"})},
            {"additionalProperties", false}}},
          {"outputSchema", outputSchemaOf(tool)},
          {"annotations",
           {{"title", tool.title},
            {"readOnlyHint", !writes},
            {"destructiveHint", false},
            {"idempotentHint", true},
            {"openWorldHint", false}}}};
}

MeshRequest requestOf(const McpTool& tool, const Json& arguments) {
  ComputationSettings settings;
  const OptionRows rows = computationRows(settings);
  std::vector<std::string> names{"mesh"};
  names.insert(names.end(), tool.arguments.begin(), tool.arguments.end());
  std::vector<std::string> optionNames;
  for (const char* const option : tool.options) optionNames.push_back(jsonName(rows, option));
  names.insert(names.end(), optionNames.begin(), optionNames.end());
  requireKeys(arguments, names, tool.name);

  Json request = Json::object(), options = tool.fixedOptions, picture{{"inline", true}};
  bool hasOption = false;
  for (const auto& [name, value] : arguments.items()) {
    const bool isOption = std::find(optionNames.begin(), optionNames.end(), name) != optionNames.end();
    const bool isOfPicture = name == "of" || name == "view";
    (isOption ? options : isOfPicture ? picture : request)[name] = value;
    hasOption = hasOption || (isOption && !value.is_null());
  }
  if (tool.needsOption && !hasOption)
    throw Error(ErrorCode::OptionConflict,
                fmt::format("{} needs a limit, for example thinnerThan; the limits and options are {}", tool.name,
                            joined(optionNames, ", ")));
  if (tool.name == std::string_view("picture")) request["picture"] = std::move(picture);
  request["options"] = std::move(options);
  return meshRequestOf(request);
}

Json toolResultOf(const MeshAnswer& answer, bool repeatsReport) {
  if (answer.report.empty())
    return toolErrorOf(answer.failure.value_or(RequestFailure{"internal", "internal error", 70}));
  Json content = Json::array({textContent(textOf(answer))});
  if (answer.picture) content.push_back({{"type", "image"}, {"data", answer.picture->data}, {"mimeType", "image/png"}});
  if (repeatsReport) content.push_back(textContent(answer.report));
  return {{"content", std::move(content)}, {"structuredContent", Json::parse(answer.report)}, {"isError", false}};
}

Json toolErrorOf(const RequestFailure& failure) {
  return {{"content", Json::array({textContent(failure.message)})},
          {"structuredContent", {{"formatVersion", kJsonFormatVersion}, {"error", failure}}},
          {"isError", true}};
}

}  // namespace asdfvk
