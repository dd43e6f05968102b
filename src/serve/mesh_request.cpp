#include "serve/mesh_request.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "describe/option_json.h"

namespace asdfvk {
namespace {

/// Greatest depth of lists in lists. The parser and the writer of JSON need stack for each level.
constexpr size_t kMaxDepth = 64;

constexpr int kUsageCode = 1;

[[noreturn]] void refuseRequest(const std::string& message) { throw Error(ErrorCode::OptionConflict, message); }

size_t depthOf(std::string_view text) {
  size_t depth = 0, greatest = 0;
  bool isInString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (isInString && c == '\\')
      ++i;
    else if (c == '"')
      isInString = !isInString;
    else if (!isInString && (c == '[' || c == '{'))
      greatest = std::max(greatest, ++depth);
    else if (!isInString && (c == ']' || c == '}') && depth > 0)
      --depth;
  }
  return greatest;
}

std::string textAt(const Json& json, const char* name) {
  const auto value = json.find(name);
  if (value == json.end() || value->is_null()) return {};
  if (!value->is_string()) refuseRequest(fmt::format("{}: {} is not a text", name, shownJson(*value)));
  auto text = value->get<std::string>();
  if (text.empty()) refuseRequest(fmt::format("{}: the text is empty", name));
  return text;
}

std::optional<RequestedFile> fileAt(const Json& json, const char* name) {
  const auto value = json.find(name);
  if (value == json.end() || value->is_null()) return std::nullopt;
  RequestedFile file;
  if (value->is_string()) {
    file.path = textAt(json, name);
    return file;
  }
  if (!value->is_object()) refuseRequest(fmt::format("{} is neither a path nor an object", name));
  file.options = *value;
  file.path = textAt(file.options, "path");
  file.options.erase("path");
  const Json isInline = file.options.value("inline", Json(file.path.empty()));
  file.options.erase("inline");
  if (!isInline.is_boolean() || isInline.get<bool>() != file.path.empty())
    refuseRequest(fmt::format("{}: give either \"path\" or \"inline\": true", name));
  return file;
}

std::vector<std::string> textsAt(const Json& json, const char* name) {
  const auto value = json.find(name);
  if (value == json.end() || value->is_null()) return {};
  const bool isList =
      value->is_array() && std::all_of(value->begin(), value->end(), [](const Json& item) { return item.is_string(); });
  if (!isList) refuseRequest(fmt::format("{}: the value is not a list of paths", name));
  return value->get<std::vector<std::string>>();
}

}  // namespace

const std::vector<RequestKey>& requestKeys() {
  const auto text = [](const char* description) {
    return Json{{"type", "string"}, {"minLength", 1}, {"description", description}};
  };
  const auto list = [](Json items, const char* description) {
    return Json{{"type", "array"}, {"items", std::move(items)}, {"description", description}};
  };
  const auto listOf = [](const char* type, int count) {
    return Json{{"type", "array"}, {"items", {{"type", type}}}, {"minItems", count}};
  };
  static const std::vector<RequestKey> keys{
      {"id", {{"description", "The answer has the same value"}}},
      {"mesh", text("Path of the mesh file, relative to the folder of the server")},
      {"format", text("Instead of mesh, with data: extension of a format, such as stl")},
      {"data", text("The bytes of a file of this format as base64")},
      {"vertices", list(listOf("number", 3), "Instead of mesh, with faces: points [x, y, z]")},
      {"faces", list(listOf("integer", 3), "Faces as lists of indices of vertices")},
      {"options", {{"type", "object"}, {"description", "Options, as in the key options of the JSON report"}}},
      {"output", {{"description", "Path of a new file for the values, or an object"}}},
      {"picture", {{"description", "Path of a PNG file, or an object"}}},
      {"with", list({{"type", "string"}}, "Paths of other parts of the assembly, to measure the clearance to them")},
      {"former", text("Path of a former version of the mesh. Only walls that are new or thinner fail")},
      {"timeout", {{"type", "number"}, {"exclusiveMinimum", 0}, {"description", "Time limit in seconds"}}},
      {"cancel", {{"description", "Cancels the requests with this id; other keys have no effect"}}},
  };
  return keys;
}

const Json& schemaOfKey(std::string_view name) {
  const auto& keys = requestKeys();
  return std::find_if(keys.begin(), keys.end(), [&](const RequestKey& key) { return key.name == name; })->schema;
}

RequestFailure invalidRequest(const std::string& message) { return {"invalidRequest", oneLine(message), kUsageCode}; }

Json parsedRequest(const std::string& text) {
  if (depthOf(text) > kMaxDepth)
    throw Error(ErrorCode::UnreadableInput, fmt::format("lists and objects are nested deeper than {}", kMaxDepth));
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::UnreadableInput, oneLine(fmt::format("the line is not JSON: {}", error.what())));
  }
}

void requireKeys(const Json& object, const std::vector<std::string>& names, const char* owner) {
  for (const auto& item : object.items())
    if (std::find(names.begin(), names.end(), item.key()) == names.end())
      throw Error(ErrorCode::UnknownName,
                  fmt::format("{} has no key '{}'{}", owner, item.key(), similarNameQuestion(item.key(), names)));
}

MeshRequest meshRequestOf(const Json& json) {
  std::vector<std::string> names;
  for (const RequestKey& key : requestKeys()) names.emplace_back(key.name);
  requireKeys(json, names, "a request");
  MeshRequest request;
  request.mesh = textAt(json, "mesh");
  request.format = textAt(json, "format");
  request.data = textAt(json, "data");
  request.vertices = json.value("vertices", Json());
  request.faces = json.value("faces", Json());
  request.options = json.value("options", Json::object());
  request.output = fileAt(json, "output");
  request.picture = fileAt(json, "picture");
  request.with = textsAt(json, "with");
  request.former = textAt(json, "former");
  const bool hasArrays = !request.vertices.is_null() || !request.faces.is_null();
  const int meshCount = (request.mesh.empty() ? 0 : 1) + (request.data.empty() ? 0 : 1) + (hasArrays ? 1 : 0);
  if (meshCount != 1)
    refuseRequest(meshCount == 0 ? "the request has no mesh; give mesh, format and data, or vertices and faces"
                                 : "the request has several meshes; give one of mesh, data, and vertices and faces");
  if (request.format.empty() != request.data.empty())
    refuseRequest("format and data belong together; give both or none");
  if (!request.options.is_object()) refuseRequest("options: the value is not an object");
  if (const auto timeout = json.find("timeout"); timeout != json.end() && !timeout->is_null()) {
    if (!timeout->is_number() || !(timeout->get<double>() > 0))
      refuseRequest(fmt::format("timeout: {} is not a number of seconds above 0", shownJson(*timeout)));
    request.timeoutSeconds = timeout->get<double>();
  }
  return request;
}

}  // namespace asdfvk
