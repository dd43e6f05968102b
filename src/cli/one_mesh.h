#pragma once

#include <exception>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>

#include "asdf_vk/mesh.h"
#include "asdf_vk/session.h"
#include "cli/exit_code.h"
#include "cli/options.h"
#include "page/page.h"
#include "process/interrupt.h"

namespace asdfvk {

/// What is done with a mesh.
struct MeshSettings {
  SessionSettings session;
  ComputationSettings computation;
  Outputs outputs;
  double timeoutSeconds = std::numeric_limits<double>::infinity();
  bool makesFolders = false;  ///< The folder of the result is made where it does not exist.
  bool isOfBatch = false;     ///< There is a record beside the result, but no report, and pages have no times.
};

/// The settings for a worker of the same program. Strings may have any bytes.
[[nodiscard]] nlohmann::ordered_json toJson(const MeshSettings& settings);
[[nodiscard]] MeshSettings settingsOf(const nlohmann::ordered_json& json);

/// Computes a mesh from file to file and prints its report. A failure is printed. Returns the exit code. Throws
/// Error{OptionConflict} where outputs contradict each other.
[[nodiscard]] ExitCode computeOneMesh(const std::string& input, const MeshSettings& settings,
                                      const std::stop_token& stop);

// The steps of that, for several meshes.

/// A mesh that was read, or the exception of its reader.
struct LoadedMesh {
  Mesh mesh;
  std::string hash;    ///< contentHash() of the file; empty unless requested.
  double seconds = 0;  ///< Time of the reading.
  std::exception_ptr failure;
};

/// A stop request ends the waiting for a FIFO or for standard input; the failure is then Error{Cancelled}.
[[nodiscard]] LoadedMesh loadMesh(const std::string& path, bool computesHash, const std::stop_token& stop);

/// What is left of a mesh that was computed. The texts are empty or consist of complete lines.
struct MeshRun {
  std::optional<Failure> failure;  ///< The first one, or the cancellation.
  std::optional<Report> report;    ///< The report, if the result is written.
  bool hasResult = false;          ///< Whether any result is written.
  std::string json;                ///< For --json.
  std::string text;                ///< Errors; outside a batch and without --quiet also warnings and report.

  /// Adds the lines of a failure of the mesh `input`.
  void add(Failure failed, const std::string& input, bool hasJson);
};

/// A page of several meshes, which the caller writes.
struct SharedPage {
  Page& page;
  std::string name;  ///< Name of the mesh in the page.
};

/// Computes and writes a mesh. A failure is part of the MeshRun. sharedPage: takes the result instead of the output, or
/// null. A stop request is taken from the deadline and ends the computation with ExitCode::Cancelled. showsBar: shows
/// the progress on a terminal.
[[nodiscard]] MeshRun computeMesh(Session& session, const std::string& input, const std::string& output,
                                  LoadedMesh loaded, const MeshSettings& settings, const Deadline& deadline,
                                  bool showsBar, const SharedPage* sharedPage = nullptr);

/// Writes a page atomically, and starts the browser with it. Waits for the reader of a FIFO; a stop request ends this
/// with Error{Cancelled}. Throws Error{OutputNotWritable}.
void finishPage(const Page& page, const std::string& output, bool opensBrowser, const std::stop_token& stop);

/// For tests that inject faults: called with the input before a mesh is computed. Null otherwise.
extern void (*beforeMesh)(const std::string& input);

}  // namespace asdfvk
