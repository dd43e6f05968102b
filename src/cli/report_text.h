#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "cli/mesh_outcome.h"

namespace asdfvk {

/// A few aligned lines. Warnings are not among them.
[[nodiscard]] std::string textReport(const MeshOutcome& outcome);

/// "the check has not passed: ..." as one line with the reason.
[[nodiscard]] std::string checkFailure(const CheckReport& check);

/// A line per device, or the reason why there is none.
[[nodiscard]] std::string textDevices(std::span<const DeviceInfo> devices, const std::string& reason);

}  // namespace asdfvk
