#pragma once

#include <span>
#include <stop_token>
#include <string>

#include "asdf_vk/session.h"
#include "cli/exit_code.h"

namespace asdfvk {

/// The lines about the devices of the session, with a remark if Vulkan runs on the CPU. Without isVerbose, there is a
/// text in two cases only: another backend replaces Vulkan, or a CPU device was chosen among several devices.
[[nodiscard]] std::string deviceLinesOf(const Session& session, const SessionOptions& options, bool isVerbose);

/// A line about the backend that BackendChoice::Automatic took because of the number of rays. Without isVerbose, there
/// is a text only for the CPU.
[[nodiscard]] std::string deviceChoiceLine(const Report& report, bool isVerbose);

/// One line per device; if there is no device, one line with the reason.
[[nodiscard]] std::string textDevices(std::span<const DeviceInfo> devices, const std::string& reason);

/// Prints the report on the device on standard output. Returns Device if the self-test failed, else Done. Throws like
/// reportDevice(). Also throws DeviceReport::failure, after printing.
[[nodiscard]] ExitCode printDeviceReport(const SessionOptions& session, const std::stop_token& stop);

/// Indented JSON with a DeviceReportDocument.
[[nodiscard]] std::string jsonDeviceReport(const struct DeviceReport& report);

/// One line with a DeviceList.
[[nodiscard]] std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason);

}  // namespace asdfvk
