#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/vec3.h"

namespace asdfvk {

/// Only layers that link nlohmann_json (src/layers.txt) may include this header.
using Json = nlohmann::ordered_json;

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

/// Defines the conversions between Struct and a JSON object with the listed members. Reading requires all members.
#define ASDFVK_JSON(Struct, ...)                                                        \
  inline void to_json(asdfvk::Json& nlohmann_json_j, const Struct& nlohmann_json_t) {   \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))            \
  }                                                                                     \
  inline void from_json(const asdfvk::Json& nlohmann_json_j, Struct& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM, __VA_ARGS__))          \
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
