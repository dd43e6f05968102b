#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/one_mesh.h"

namespace asdfvk {

/// The settings for a worker of the same program: values without names, in the order of the members. Strings may have
/// any bytes.
[[nodiscard]] nlohmann::ordered_json toJson(const MeshSettings& settings);
[[nodiscard]] MeshSettings settingsOf(const nlohmann::ordered_json& json);

}  // namespace asdfvk
