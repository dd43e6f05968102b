#include "cli/request_line.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "asdf_vk/error.h"
#include "cli/input_options.h"
#include "cli/program_options.h"
#include "core/text.h"
#include "describe/option_json.h"
#include "describe/report_json.h"
#include "serve/json_schema.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

constexpr OptionSpelling kRequestSpelling = OptionSpelling::CamelCase;

/// Lists of texts become one text, such as "sdf,seed".
Json withJoinedLists(Json options) {
  for (auto& [key, value] : options.items())
    if (value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_string(); }))
      value = joined(value.get<std::vector<std::string>>(), ",");
  return options;
}

OptionRows chosenRows(OptionRows rows, std::initializer_list<std::string_view> names) {
  std::erase_if(rows,
                [&](const OptionRow& row) { return std::find(names.begin(), names.end(), row.name) == names.end(); });
  return rows;
}

/// The options of the file of values.
OptionRows resultRows(Outputs& outputs) {
  return chosenRows(outputRows(outputs), {"format", "fields", "ascii", "colour-of", "vertex-colours"});
}
OptionRows pictureRows(Outputs& outputs) {
  return chosenRows(outputRows(outputs), {"picture-of", "picture-view", "picture-up"});
}
/// Shorter names of options in the object of a picture.
constexpr const char *kPictureOf = "pictureOf", *kShortOf = "of", *kPictureView = "pictureView", *kShortView = "view";

void setFileOptions(const OptionRows& rows, const Json& options, GivenOptions& given) {
  given.names.merge(setOptions({&rows, 1}, withJoinedLists(options)).names);
}

/// Throws Error{OptionConflict} if an option of the session has another value than in the server.
void requireSameSession(const SessionSettings& wanted, const SessionSettings& session) {
  SessionSettings changed = wanted, present = session;
  const OptionRows rows = sessionRows(changed), presentRows = sessionRows(present);
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i].member.write() != presentRows[i].member.write())
      throw Error(ErrorCode::OptionConflict,
                  fmt::format("{} is an option of the server: start it with {} {}", spelled(rows[i], kRequestSpelling),
                              spelled(rows[i], OptionSpelling::Flag), toText(rows[i].member.write())));
}

std::string outputPath(const std::string& path, const RequestFiles& files) {
  std::string resolved = files.root.resolved(path, ErrorCode::OutputNotWritable);
  std::error_code ignored;
  const bool isResult = fs::path(resolved).stem().extension() == ".asdf";
  if (files.protectsFiles && !isResult && fs::exists(resolved, ignored))
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("{} exists; choose a new name, or one such as NAME.asdf.ply, which is replaced", path));
  return resolved;
}

void setOutputs(const MeshRequest& request, const RequestFiles& files, const std::string& temporary, CommandLine& line,
                GivenOptions& given) {
  Outputs& outputs = line.outputs;
  if (request.output) {
    setFileOptions(resultRows(outputs), request.output->options, given);
    if (request.output->path.empty() && outputs.format.empty())
      throw Error(ErrorCode::OptionConflict,
                  fmt::format("output: an inline result needs a format, one of {}", joined(outputFormats(), ", ")));
    outputs.path = request.output->path.empty() ? (fs::path(temporary) / ("result." + outputs.format)).string()
                                                : outputPath(request.output->path, files);
    given.names.insert("output");
  }
  if (request.picture) {
    Json options = Json::object();
    for (const auto& [key, value] : request.picture->options.items())
      options[key == kShortOf ? kPictureOf : key == kShortView ? kPictureView : key] = value;
    setFileOptions(pictureRows(outputs), options, given);
    outputs.picture = request.picture->path.empty() ? (fs::path(temporary) / "picture.png").string()
                                                    : outputPath(request.picture->path, files);
    if (!outputs.picture.ends_with(".png"))
      throw Error(ErrorCode::OptionOutOfRange, "picture: the name does not end in .png");
    given.names.insert("picture");
  }
}

/// The schema of an object with a path or `inline`, and options.
Json fileSchema(const OptionRows& rows) {
  Json schema = optionsSchema({&rows, 1}, kRequestSpelling);
  schema["properties"].update(
      {{"path", {{"type", "string"}, {"minLength", 1}, {"description", "Path of the file"}}},
       {"inline", {{"type", "boolean"}, {"description", "Instead of path: the answer has the bytes of the file"}}}});
  return schema;
}

}  // namespace

std::string inputPath(const std::string& path, const RequestFiles& files) {
  std::string resolved = files.root.resolved(path, ErrorCode::UnreadableInput);
  std::error_code ignored;
  const fs::file_status status = fs::status(resolved, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error(ErrorCode::UnreadableInput,
                fmt::format("{} is {}", path, fs::is_directory(status) ? "a folder" : "not a regular file"));
  return resolved;
}

std::string meshNameOf(const MeshRequest& request) {
  return !request.mesh.empty() ? request.mesh : request.format.empty() ? "mesh" : "mesh." + request.format;
}

CommandLine commandLineOf(const MeshRequest& request, const SessionSettings& session, const RequestFiles& files,
                          const std::string& temporary) {
  CommandLine line;
  line.session = session;
  const std::array<OptionRows, 3> tables{computationRows(line.computation), readingRows(line.reading),
                                         sessionRows(line.session)};
  GivenOptions given = setOptions(tables, request.options);
  requireSameSession(line.session, session);
  line.meshes = {meshNameOf(request)};
  for (const std::string& path : request.with) line.others.with.push_back(inputPath(path, files));
  if (!request.former.empty()) line.others.former = inputPath(request.former, files);
  setOutputs(request, files, temporary, line, given);
  completeLine(line, given);
  line.outputs.writesResult = request.output.has_value();
  line.outputs.json = true;
  line.outputs.quiet = true;
  return line;
}

Json requestDefinitions() {
  CommandLine line;
  const std::array<OptionRows, 3> tables{computationRows(line.computation), readingRows(line.reading),
                                         sessionRows(line.session)};
  Json result = fileSchema(resultRows(line.outputs)), picture = fileSchema(pictureRows(line.outputs));
  Json& fields = result["properties"]["fields"];
  fields = {{"type", {"string", "array", "null"}},  // A text has several names with commas between them.
            {"items", fields["anyOf"][0]},
            {"description", fields["description"]}};
  picture["properties"][kShortOf] = picture["properties"][kPictureOf];
  picture["properties"][kShortView] = picture["properties"][kPictureView];

  Json properties = Json::object();
  for (const RequestKey& key : requestKeys()) properties[key.name] = key.schema;
  const auto refer = [&](const char* key, const char* name) {
    Json& schema = properties[key];
    const bool isPath = !schema.contains("type");
    const Json reference = schemaReference(name);
    if (isPath)
      schema["anyOf"] = {{{"type", "string"}, {"minLength", 1}}, reference};
    else
      schema = {{"description", schema["description"]}, {"$ref", reference["$ref"]}};
  };
  refer("options", "RequestOptions");
  refer("output", "RequestOutput");
  refer("picture", "RequestPicture");
  Json meshes = Json::array();
  for (const Json& keys : {Json{"mesh"}, Json{"format", "data"}, Json{"vertices", "faces"}, Json{"cancel"}})
    meshes.push_back({{"required", keys.is_array() ? keys : Json::array({keys})}});
  return {{"Request",
           {{"description", "A request to compute a mesh, or to cancel such requests."},
            {"type", "object"},
            {"properties", std::move(properties)},
            {"anyOf", std::move(meshes)},
            {"additionalProperties", false}}},
          {"RequestOptions", optionsSchema(tables, kRequestSpelling)},
          {"RequestOutput", std::move(result)},
          {"RequestPicture", std::move(picture)}};
}

}  // namespace asdfvk
