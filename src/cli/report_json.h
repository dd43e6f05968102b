#pragma once

#include <span>
#include <string>

#include "cli/mesh_outcome.h"

namespace asdfvk {

// Each is one JSON document on one line, the line feed included. Numbers that are not finite become null, bytes that
// are not UTF-8 the replacement character.

/// Lengths are in the mesh's unit, times in seconds.
[[nodiscard]] std::string jsonReport(const MeshOutcome& outcome);
/// {"mesh": ..., "error": ...}
[[nodiscard]] std::string jsonFailure(const std::string& mesh, const std::string& message);
/// {"devices": [...], "reason": ...}; reason tells why there are none.
[[nodiscard]] std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason);

}  // namespace asdfvk
