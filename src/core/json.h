#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/vec3.h"

namespace asdfvk {

/// Only layers that link nlohmann_json (src/layers.txt) may include this header.
using Json = nlohmann::ordered_json;

/// Null where the value is not finite.
[[nodiscard]] inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
/// The three coordinates.
[[nodiscard]] inline Json arrayOf(const Vec3d& v) { return {number(v.x), number(v.y), number(v.z)}; }

}  // namespace asdfvk
