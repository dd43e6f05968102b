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
#include "describe/report_text.h"
#include "page/page.h"

namespace asdfvk {

struct MeshOutcome {
  const std::string& mesh;    ///< Path of the mesh, as on the command line.
  const std::string& output;  ///< Path of the result; "-" for standard output; empty: none.
  const ComputationSettings& computation;
  const SessionSettings& session;
  const OtherMeshes& others;
  const Outputs& outputs;
  const Result& result;
  std::vector<uint64_t> withFaceCounts = {};  ///< ComputedMesh::faceCounts
};

/// The report as aligned lines. The first line has the name of the mesh, and the verdict on the thickness or the size
/// of the mesh. Lines with further results and with the output files follow. With --verbose the report has all of
/// reportRows(). Without --verbose the report has at most six lines of at most 100 columns; long file names take more
/// columns.
[[nodiscard]] std::string textReport(const MeshOutcome& outcome);

/// The lines about the devices of the session, with a remark if Vulkan runs on the CPU. Without isVerbose, there is a
/// text in two cases only: another backend replaces Vulkan, or a CPU device was chosen among several devices.
[[nodiscard]] std::string deviceLinesOf(const Session& session, const SessionOptions& options, bool isVerbose);

/// One line per device; if there is no device, one line with the reason.
[[nodiscard]] std::string textDevices(std::span<const DeviceInfo> devices, const std::string& reason);

/// One line of JSON with the keys of docs/formats.md.
[[nodiscard]] std::string jsonReport(const MeshOutcome& outcome);

/// One line with the keys "mesh", "error" and "code".
[[nodiscard]] std::string jsonFailure(const std::string& mesh, const std::string& code, const std::string& message);

/// One line with the keys "mesh", "output", "status" and "record", for a mesh that --skip-existing skips.
[[nodiscard]] std::string jsonSkipped(const std::string& mesh, const MeshRecord& record);

/// Prints the report on the device on standard output. Returns Device if the self-test failed, else Done. Throws like
/// reportDevice(). Also throws DeviceReport::failure, after printing.
[[nodiscard]] ExitCode printDeviceReport(const SessionOptions& session, const std::stop_token& stop);

/// Indented JSON with the keys of docs/devices.md.
[[nodiscard]] std::string jsonDeviceReport(const struct DeviceReport& report);

[[nodiscard]] std::string jsonDevices(std::span<const DeviceInfo> devices, const std::string& reason);

[[nodiscard]] std::string nameInPage(const std::string& mesh);

/// Name of a mesh in a page, and whether the page shows times.
struct PageMesh {
  std::string name;
  bool showsTimes = true;
};

/// Adds a result to a page, with its report and a small picture. Precondition: the result has a scene. Throws
/// Error{UnknownField} if the result lacks a field of --fields, and Error{Cancelled}.
void addToPage(Page& page, const MeshOutcome& outcome, const PageMesh& mesh, const RunControl& control);

}  // namespace asdfvk
