#include "cli/mesh_settings.h"

#include <utility>

#include "batch/content_hash.h"
#include "cli/command_line.h"
#include "cli/input_options.h"
#include "cli/program_options.h"
#include "core/json.h"
#include "describe/option_json.h"
#include "describe/report_json.h"

namespace asdfvk {
namespace {

/// The values of the options, by the name of the row.
Json valuesOf(const OptionRows& rows) {
  Json json = Json::object();
  for (const OptionRow& row : rows) json[row.name] = toJson(row.member.write());
  return json;
}

void setValues(const OptionRows& rows, const Json& json) {
  for (const OptionRow& row : rows) {
    const Json& value = json.at(row.name);
    if (!value.is_null()) setOption(row, optionValueOf(value), row.name, OptionSpelling::Flag);
  }
}

}  // namespace

MeshSettings meshSettingsOf(const CommandLine& line) {
  return {.session = line.session,
          .computation = line.computation,
          .reading = line.reading,
          .others = line.others,
          .outputs = line.outputs,
          .timeoutSeconds = line.batch.timeoutSeconds,
          .makesFolders = line.batch.hasTree() || line.outputs.path.ends_with('/'),
          .isOfBatch = line.batch.isBatch()};
}

std::string optionsHash(const ComputationSettings& computation, const SessionSettings& session,
                        const ReadOptions& reading, const Outputs& outputs) {
  Json identity{{"options", optionValues(computation, session)},
                {"chordError", {reading.chordError, reading.chordErrorUnit}},
                {"fields", fieldNames(outputs, computation.options)},
                {"choosesFields", !outputs.fields.empty()},
                {"format", outputs.format},
                {"colourOf", outputs.colourOf},
                {"vertexColours", outputs.coloursVertices},
                {"ascii", outputs.ascii}};
  // --picture alone changes no hash; JobRecords::findFinished() looks for the picture.
  const View& view = outputs.pictureView;
  if (!outputs.pictureOf.empty() || outputs.choosesView || view.up)
    identity["picture"] = {outputs.pictureOf, view.azimuthDegrees, view.elevationDegrees,
                           view.up ? static_cast<int>(*view.up) : -1};
  return contentHash(jsonText(identity));
}

Json toJson(MeshSettings settings) {
  return {{"computation", valuesOf(computationRows(settings.computation))},
          {"session", valuesOf(sessionRows(settings.session))},
          {"reading", valuesOf(readingRows(settings.reading))},
          {"outputs", valuesOf(outputRows(settings.outputs))},
          {"limits", settings.policy.limits},
          {"baseline", settings.policy.baseline},
          {"keepsScene", settings.computation.options.keepsScene},
          {"timeoutSeconds", settings.timeoutSeconds},
          {"makesFolders", settings.makesFolders},
          {"isOfBatch", settings.isOfBatch},
          {"memberFolder", settings.memberFolder}};
}

MeshSettings settingsOf(const Json& json) {
  MeshSettings settings;
  setValues(computationRows(settings.computation), json.at("computation"));
  setValues(sessionRows(settings.session), json.at("session"));
  setValues(readingRows(settings.reading), json.at("reading"));
  setValues(outputRows(settings.outputs), json.at("outputs"));
  json.at("limits").get_to(settings.policy.limits);
  json.at("baseline").get_to(settings.policy.baseline);
  settings.computation.options.keepsScene = json.at("keepsScene");
  settings.timeoutSeconds = json.at("timeoutSeconds");
  settings.makesFolders = json.at("makesFolders");
  settings.isOfBatch = json.at("isOfBatch");
  settings.memberFolder = json.at("memberFolder");
  return settings;
}

}  // namespace asdfvk
