#include "describe/option_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/json.h"
#include "describe/computation_options.h"

namespace asdfvk {
namespace {

constexpr OptionSpelling kJsonSpelling = OptionSpelling::CamelCase;

/// The name with small letters and digits only: "thinnerthan" for "thinnerThan", "thinner_than" and "--thinner-than".
std::string withoutSeparators(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (c == '-' || c == '_') continue;
    letters += 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return letters;
}

/// The types of JSON of an option whose values have the types `types` in Python, for example "float | str".
Json typesNamedBy(std::string_view types) {
  Json names = Json::array();
  if (types.find("float") != std::string_view::npos)
    names.push_back("number");
  else if (types.find("int") != std::string_view::npos)
    names.push_back("integer");
  names.push_back("string");
  return names.size() == 1 ? names[0] : names;
}

Json typeOf(const OptionCodec& codec) {
  switch (codec.kind) {
    case OptionKind::Flag:
      return "boolean";
    case OptionKind::Whole:
      return "integer";
    case OptionKind::Real:
      return "number";
    case OptionKind::Text:
      break;
  }
  return typesNamedBy(codec.pythonType == nullptr ? "str" : codec.pythonType);
}

/// Numbers without a fraction as integers.
Json boundOf(double bound) {
  constexpr double kMaxExact = 9007199254740992;
  if (std::floor(bound) == bound && std::abs(bound) < kMaxExact) return static_cast<int64_t>(bound);
  return bound;
}

}  // namespace

OptionValue optionValueOf(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_unsigned()) return json.get<uint64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return {};
}

std::string similarNameQuestion(std::string_view name, const std::vector<std::string>& names) {
  const std::string letters = withoutSeparators(name);
  const auto same =
      std::find_if(names.begin(), names.end(), [&](const auto& other) { return withoutSeparators(other) == letters; });
  const std::string similar = same != names.end() ? *same : similarNames(name, names);
  return similar.empty() ? "" : fmt::format("; did you mean {}?", similar);
}

GivenOptions setOptions(std::span<const OptionRows> tables, const Json& values) {
  std::vector<std::string> names;
  for (const OptionRows& rows : tables)
    for (const OptionRow& row : rows) names.push_back(spelled(row, kJsonSpelling));
  for (const auto& item : values.items()) {
    const std::string& name = item.key();
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    if (const std::string removed = removedOptionText(name, kJsonSpelling); !removed.empty())
      throw Error(ErrorCode::UnknownName, removed, {{"option", name}});
    throw Error(ErrorCode::UnknownName,
                fmt::format("there is no option '{}'{}", name, similarNameQuestion(name, names)), {{"option", name}});
  }
  GivenOptions given{.names = {}, .spelling = kJsonSpelling};
  for (const OptionRows& rows : tables)
    for (const OptionRow& row : rows) {
      const auto value = values.find(spelled(row, kJsonSpelling));
      if (value == values.end() || value->is_null()) continue;
      setOption(row, optionValueOf(*value), shownJson(*value), kJsonSpelling);
      given.names.insert(row.name);
    }
  return given;
}

Json optionSchema(const OptionRow& row, const OptionRows& rows) {
  Json schema{{"type", typeOf(row.member.codec())}};
  if (const std::vector<std::string> names = namesOf(row); !names.empty() && schema["type"] == "string")
    schema["enum"] = names;
  const OptionRange& range = row.range;
  if (std::isfinite(range.min)) schema[range.excludesMin ? "exclusiveMinimum" : "minimum"] = boundOf(range.min);
  if (std::isfinite(range.max)) schema[range.excludesMax ? "exclusiveMaximum" : "maximum"] = boundOf(range.max);
  std::string text = row.text;
  if (schema["type"].is_array()) text += fmt::format(". The value is {}", wantedText(row));
  if (const std::string value = defaultText(row); value != "-" && !isFlag(row)) text += "; default " + value;
  schema["description"] = withSpelledOptions(rows, text, kJsonSpelling);
  return schema;
}

Json orNull(Json schema) {
  if (schema.contains("type") && !schema.contains("enum")) {
    Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
    if (std::find(types.begin(), types.end(), "null") == types.end()) types.push_back("null");
    schema["type"] = std::move(types);
    return schema;
  }
  Json nullable = Json::object();
  if (schema.contains("description")) nullable["description"] = schema["description"];
  schema.erase("description");
  nullable["anyOf"] = {std::move(schema), {{"type", "null"}}};
  return nullable;
}

Json optionsSchema(std::span<const OptionRows> tables, OptionSpelling spelling) {
  Json properties = Json::object();
  for (const OptionRows& rows : tables)
    for (const OptionRow& row : rows)
      if (const std::string name = spelled(row, spelling); !name.empty())
        properties[name] = orNull(optionSchema(row, rows));
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

}  // namespace asdfvk
