#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace asdfvk {

using Json = nlohmann::ordered_json;

/// Null where the value is not finite.
[[nodiscard]] inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace asdfvk
