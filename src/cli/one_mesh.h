#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>

#include "asdf_vk/mesh.h"
#include "asdf_vk/session.h"
#include "cli/exit_code.h"
#include "cli/loaded_mesh.h"
#include "cli/mesh_settings.h"
#include "page/page.h"
#include "process/interrupt.h"

namespace asdfvk {

/// Computes a mesh and reports the result or a failure. Throws Error{OptionConflict} if outputs contradict each other.
[[nodiscard]] ExitCode computeOneMesh(const std::string& input, const MeshSettings& settings,
                                      const std::stop_token& stop);

// Steps of computeOneMesh(), for calls with several meshes.

/// Outcome of a mesh. `json` and `text` are empty or consist of complete lines.
struct MeshRun {
  std::optional<Failure> failure;  ///< The first failure, or the cancellation.
  std::optional<Report> report;    ///< Set if the mesh was computed, and its result was written.
  bool hasResult = false;          ///< Whether the mesh was computed, and its result was written.
  std::string picture;             ///< Path of the picture that was written; empty: none.
  std::string json;                ///< Lines of --json.
  std::string text;                ///< Errors. Outside of batches and without --quiet, also warnings and the report.

  void add(Failure failed, const std::string& input, bool hasJson);
};

/// A page for several meshes, which the caller writes.
struct SharedPage {
  Page& page;
  std::string name;  ///< Name of the mesh in the page.
};

/// Where the progress of a mesh is shown.
struct MeshProgress {
  bool showsBar = false;                              ///< Shows a progress bar if standard error is a terminal.
  std::function<void(double fraction)> receive = {};  ///< Replaces the bar; may be empty.
};

/// Computes a mesh and writes its result. output: empty for no result. Failures are returned in the MeshRun. A stop
/// request or the expiry of `deadline` ends the computation. sharedPage: if not null, receives the result instead of
/// the file `output`.
[[nodiscard]] MeshRun computeMesh(Session& session, const std::string& input, const std::string& output,
                                  LoadedMesh loaded, const MeshSettings& settings, const Deadline& deadline,
                                  const MeshProgress& progress, const SharedPage* sharedPage = nullptr);

/// Writes a page atomically. opensBrowser: opens the page in the browser. If the output is a FIFO, waits for its
/// reader; a stop request ends this wait with Error{Cancelled}. Throws Error{OutputNotWritable}.
void finishPage(const Page& page, const std::string& output, bool opensBrowser, const std::stop_token& stop);

/// Called before a mesh is computed. Does nothing. The definition is weak, so that a test program with another
/// definition can simulate faults.
void beforeMesh(const std::string& input);

}  // namespace asdfvk
