#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/session.h"
#include "batch/mesh_record.h"
#include "cli/exit_code.h"
#include "cli/options.h"
#include "describe/report_json.h"
#include "page/page.h"

namespace asdfvk {

/// One computed mesh, the input of both reports. Views only.
struct MeshOutcome {
  const std::string& mesh;    ///< The argument of the command line.
  const std::string& output;  ///< Path of the result; "-" for standard output.
  const ComputationSettings& computation;
  const SessionSettings& session;
  const Outputs& outputs;
  const Result& result;
};

/// Title and text; a row without a title continues the one before.
using ReportRows = std::vector<std::pair<std::string, std::string>>;

/// Thickness where it is measured, its verdict first, or the rows of the short report; then the details of values and
/// parts, seeds, device, solver and times. Titles have at most nine characters.
[[nodiscard]] ReportRows reportRows(const Report& report);

/// A title with the mesh or the verdict, rows and files, as aligned lines. Without --verbose at most six lines of at
/// most 100 columns, longer names of files apart; else all of reportRows().
[[nodiscard]] std::string textReport(const MeshOutcome& outcome);

/// "the check failed: ..." with the reason, one line.
[[nodiscard]] std::string checkFailure(const CheckReport& check);

/// The verdict, then unjudged faces, size, thin regions, sharp edges, greatest section, percentiles. Precondition:
/// report.thickness.
[[nodiscard]] ReportRows thicknessRows(const Report& report);

/// At most three rows: the verdict, such as "FAIL: thinner than 0.8: 0.3 at (0, 1, 2), face 12", or without a limit the
/// least thickness; where faces are not judged, how many; the thickness and the thin regions.
[[nodiscard]] ReportRows shortThicknessRows(const ThicknessReport& thickness);

/// The message and, where there is one, the remedy by options.
[[nodiscard]] std::string textWarning(const Warning& warning);

/// The lines of the session, with a remark where the CPU runs Vulkan. Unless `isVerbose`, empty where the device is the
/// expected one: neither a replacement of Vulkan, nor a CPU device beside another device.
[[nodiscard]] std::string deviceLinesOf(const Session& session, const SessionOptions& options, bool isVerbose);

/// One line per device, or the reason why there is none.
[[nodiscard]] std::string textDevices(std::span<const DeviceInfo> devices, const std::string& reason);

/// One line of JSON with the keys of docs/formats.md.
[[nodiscard]] std::string jsonReport(const MeshOutcome& outcome);

/// One line with the keys "mesh", "error" and "code".
[[nodiscard]] std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message);

/// One line with the keys "mesh", "output", "status" and "record", for a mesh that --skip-existing skips.
[[nodiscard]] std::string jsonSkipped(const std::string& mesh, const MeshRecord& record);

/// Prints the report on the device on standard output. Returns Done, or Device where its self-test failed. Throws as
/// reportDevice(), and DeviceReport::failure after printing.
[[nodiscard]] ExitCode printDeviceReport(const SessionOptions& session, const std::stop_token& stop);

/// Indented JSON with the keys of docs/devices.md.
[[nodiscard]] std::string jsonDeviceReport(const struct DeviceReport& report);

[[nodiscard]] std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason);

/// A page without results.
[[nodiscard]] Page emptyPage();

/// The name of a mesh in a page, if no other mesh of the page has it.
[[nodiscard]] std::string nameInPage(const std::string& mesh);

/// How a page shows a mesh.
struct PageMesh {
  std::string name;
  bool showsTimes = true;
};

/// Adds a result with the texts of its report and a small picture. Precondition: result.scene is set. Throws
/// Error{UnknownField} for a field of --fields that the result does not have, and Error{Cancelled}.
void addToPage(Page& page, const MeshOutcome& outcome, const PageMesh& mesh, const RunControl& control);

/// Writes the page atomically. Throws Error{OutputNotWritable}.
void writePage(const std::string& path, const Page& page);

}  // namespace asdfvk
