#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/vec3.h"

namespace asdfvk {

/// Only layers that link nlohmann_json (src/layers.txt) may include this header.
using Json = nlohmann::ordered_json;

/// The key formatVersion of each JSON document. A key that is removed or changes its type or meaning increases it.
inline constexpr int kJsonFormatVersion = 1;

/// A member whose key exists only with a value. A std::optional without a value is null instead.
template <typename T>
struct OptionalKey : std::optional<T> {
  using std::optional<T>::optional;
};

template <typename T>
void putKey(Json& json, const char* key, const T& member) {
  json[key] = member;
}
template <typename T>
void putKey(Json& json, const char* key, const OptionalKey<T>& member) {
  if (member) json[key] = *member;
}
template <typename T>
void takeKey(const Json& json, const char* key, T& member) {
  json.at(key).get_to(member);
}
template <typename T>
void takeKey(const Json& json, const char* key, OptionalKey<T>& member) {
  if (json.contains(key)) member = json.at(key).get<T>();
}

/// indent: -1 for one line. Bytes that are not UTF-8 are replaced.
[[nodiscard]] inline std::string jsonText(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// The value for a message: one line, cut after 60 bytes.
[[nodiscard]] inline std::string shownJson(const Json& json) {
  constexpr size_t kMaxShown = 60;
  const std::string text = jsonText(json);
  return text.size() <= kMaxShown ? text : text.substr(0, kMaxShown) + "...";
}

[[nodiscard]] inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
[[nodiscard]] inline Json arrayOf(const Vec3d& v) { return {number(v.x), number(v.y), number(v.z)}; }

}  // namespace asdfvk

#define ASDFVK_VISIT_KEY(member) asdfvkVisit(#member, asdfvkValue.member);
#define ASDFVK_TAKE_KEY(member) asdfvk::takeKey(asdfvkJson, #member, asdfvkValue.member);

/// Defines the conversion of Struct to a JSON object with the listed members, and visitKeys(), which calls
/// visit(key, member) for each of them.
#define ASDFVK_JSON_KEYS(Struct, ...)                                                                              \
  constexpr const char* structureName(const Struct&) { return #Struct; }                                           \
  template <typename Visit>                                                                                        \
  void visitKeys(const Struct& asdfvkValue, const Visit& asdfvkVisit) {                                            \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(ASDFVK_VISIT_KEY, __VA_ARGS__))                                       \
  }                                                                                                                \
  inline void to_json(asdfvk::Json& asdfvkJson, const Struct& asdfvkValue) {                                       \
    visitKeys(asdfvkValue, [&](const char* key, const auto& member) { asdfvk::putKey(asdfvkJson, key, member); }); \
  }

/// Defines the conversions in both directions. Reading requires all members except for OptionalKey.
#define ASDFVK_JSON(Struct, ...)                                               \
  ASDFVK_JSON_KEYS(Struct, __VA_ARGS__)                                        \
  inline void from_json(const asdfvk::Json& asdfvkJson, Struct& asdfvkValue) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(ASDFVK_TAKE_KEY, __VA_ARGS__))    \
  }

template <typename T>
struct nlohmann::adl_serializer<std::optional<T>> {
  static void to_json(asdfvk::Json& json, const std::optional<T>& value) {
    json = value ? asdfvk::Json(*value) : asdfvk::Json(nullptr);
  }
  static void from_json(const asdfvk::Json& json, std::optional<T>& value) {
    value = json.is_null() ? std::nullopt : std::optional(json.get<T>());
  }
};

/// An object with the keys in the order of the list.
template <typename T>
requires std::is_arithmetic_v<T>
struct nlohmann::adl_serializer<std::vector<std::pair<std::string, T>>> {
  static void to_json(asdfvk::Json& json, const std::vector<std::pair<std::string, T>>& list) {
    json = asdfvk::Json::object();
    for (const auto& [key, value] : list) json[key] = value;
  }
};
