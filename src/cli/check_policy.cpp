#include "cli/check_policy.h"

#include <fmt/core.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <tuple>
#include <variant>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "describe/option_json.h"
#include "describe/option_rules.h"
#include "describe/report_json.h"
#include "serve/json_schema.h"
#include "serve/mesh_request.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

constexpr const char *kRulesKey = "limits", *kFilesKey = "files", *kSchemaKey = "$schema";
constexpr std::array kLimitNames{"fail-if-thinner", "fail-if-thicker", "fail-if-closer", "fail-if-voids",
                                 "fail-if-contact", "count-details",   "count-edges"};

bool matches(const LimitRule& rule, const std::string& path) {
  const bool isName = rule.files.find('/') == std::string::npos;
  return fnmatch(rule.files.c_str(), (isName ? fs::path(path).filename().string() : path).c_str(), 0) == 0;
}

/// Unset for null. Throws Error{UnreadableInput}.
OptionValue valueOf(const Json& json, const std::string& name) {
  if (json.is_structured())
    throw Error(ErrorCode::UnreadableInput,
                fmt::format("the limit {} is neither a number, a text such as \"0.8mm\", true, false nor null", name));
  return optionValueOf(json);
}

void removeLimit(ComputationSettings& settings, const std::string& name) {
  ThicknessOptions& thickness = settings.options.thickness;
  for (const auto& [limit, failIf, reported] :
       {std::tuple{"fail-if-thinner", &settings.failIfThinner, &thickness.thinnerThan},
        std::tuple{"fail-if-thicker", &settings.failIfThicker, &thickness.thickerThan},
        std::tuple{"fail-if-closer", &settings.failIfCloser, &thickness.closerThan}}) {
    if (name != limit) continue;
    failIf->reset();
    reported->reset();
  }
}

LimitRule ruleOf(const Json& json) {
  if (!json.is_object() || !json.contains(kFilesKey) || !json[kFilesKey].is_string())
    throw Error(ErrorCode::UnreadableInput,
                "a rule has no \"files\"; write, for example, {\"files\": \"*.stl\", \"fail-if-thinner\": 0.8}");
  LimitRule rule{json[kFilesKey], {}};
  for (const auto& [name, value] : json.items()) {
    if (name == kFilesKey) continue;
    if (std::find(kLimitNames.begin(), kLimitNames.end(), name) == kLimitNames.end())
      throw Error(ErrorCode::UnreadableInput,
                  fmt::format("'{}' is not one of {}", name,
                              joined(std::vector<std::string>(kLimitNames.begin(), kLimitNames.end()), "|")));
    rule.options.emplace_back(name, valueOf(value, name));
  }
  return rule;
}

}  // namespace

ComputationSettings LimitRules::applied(const std::string& mesh, const ComputationSettings& settings) const {
  ComputationSettings changed = settings;
  if (rules.empty()) return changed;
  const std::string path = pathBelow(folder, mesh);
  const OptionRows rows = computationRows(changed);
  for (const LimitRule& rule : rules) {
    if (!matches(rule, path)) continue;
    for (const auto& [name, value] : rule.options) {
      removeLimit(changed, name);
      if (std::holds_alternative<std::monostate>(value)) continue;
      setOption(*findOption(rows, name), value, toText(value), OptionSpelling::Name);
    }
  }
  // Options without an effect are no mistake here: another rule may have removed the limit that they need.
  ThicknessOptions& thickness = changed.options.thickness;
  if (!changed.failIfThinner && !changed.failIfCloser) thickness.countsDetails = thickness.countsEdges = false;
  complete(changed, {.names = {}, .spelling = OptionSpelling::Name});
  return changed;
}

LimitRules readLimits(const std::string& path) {
  try {
    const Json json = readObject(path, "the file of limits");
    LimitRules limits{fs::absolute(path).lexically_normal().parent_path().string(), {}};
    if (!json.contains(kRulesKey) || !json[kRulesKey].is_array())
      throw Error(ErrorCode::UnreadableInput, "there is no list \"limits\"; write {\"limits\": [...]}");
    requireKeys(json, {kRulesKey, kSchemaKey}, "the file");
    for (const Json& rule : json[kRulesKey]) limits.rules.push_back(ruleOf(rule));
    for (const LimitRule& rule : limits.rules)  // Each rule alone must be valid.
      (void)LimitRules{"/", {{"*", rule.options}}}.applied("any", {});
    return limits;
  } catch (const Error& error) {
    const std::string text = error.what();
    throw Error(error.code(), text.find(path) != std::string::npos ? text : fmt::format("{}: {}", path, text));
  }
}

Json limitDefinitions() {
  ComputationSettings settings;
  OptionRows rows = computationRows(settings);
  std::erase_if(rows, [](const OptionRow& row) {
    return std::find(kLimitNames.begin(), kLimitNames.end(), std::string_view(row.name)) == kLimitNames.end();
  });
  Json rule = optionsSchema({&rows, 1}, OptionSpelling::Name);
  rule["description"] = "Limits of the meshes that match a pattern. Null removes a limit.";
  rule["properties"][kFilesKey] = {
      {"type", "string"}, {"description", "Pattern of the names of the meshes; with a slash, of their paths."}};
  rule["required"] = Json::array({kFilesKey});
  return {{"LimitFile",
           {{"description", "Limits of single meshes. All rules that match a mesh apply; the last one wins."},
            {"type", "object"},
            {"properties",
             {{kSchemaKey, {{"type", "string"}, {"description", "For editors; ignored."}}},
              {kRulesKey, {{"type", "array"}, {"items", schemaReference("LimitRule")}}}}},
            {"required", Json::array({kRulesKey})},
            {"additionalProperties", false}}},
          {"LimitRule", std::move(rule)}};
}

void to_json(Json& json, const LimitRules& limits) {
  json = {{"folder", limits.folder}, {kRulesKey, Json::array()}};
  for (const LimitRule& rule : limits.rules) {
    Json row{{kFilesKey, rule.files}};
    for (const auto& [name, value] : rule.options) row[name] = toJson(value);
    json[kRulesKey].push_back(std::move(row));
  }
}

void from_json(const Json& json, LimitRules& limits) {
  json.at("folder").get_to(limits.folder);
  for (const Json& rule : json.at(kRulesKey)) limits.rules.push_back(ruleOf(rule));
}

}  // namespace asdfvk
