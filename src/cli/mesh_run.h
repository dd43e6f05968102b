#pragma once

#include <exception>
#include <optional>
#include <stop_token>
#include <string>

#include "asdf_vk/mesh.h"
#include "asdf_vk/session.h"
#include "batch/mesh_record.h"
#include "cli/exit_code.h"
#include "cli/options.h"
#include "cli/page_output.h"

namespace asdfvk {

/// One mesh of a call.
struct MeshTask {
  std::string input, output;  ///< "-" for the standard streams.
  uint64_t byteCount = 0;     ///< Of the input; 0 where it is unknown.
};

/// The result of a mesh. The texts are empty or consist of complete lines.
struct MeshRun {
  ExitCode code = ExitCode::Done;
  std::string json;   ///< For --json.
  std::string text;   ///< For standard error: errors. Outside a batch and without --quiet also warnings and report.
  MeshRecord record;  ///< Complete in a batch only.
};

/// A mesh that was read, or the exception of its reader.
struct LoadedMesh {
  Mesh mesh;
  std::string hash;    ///< contentHash() of the file; empty unless requested.
  double seconds = 0;  ///< Of the reading.
  std::exception_ptr failure;
};

/// A stop request ends the waiting for a FIFO or for standard input; the failure is then Error{Cancelled}. Throws
/// std::system_error where the waiting needs a thread and the system allows none.
[[nodiscard]] LoadedMesh loadMesh(const std::string& path, bool computesHash, const std::stop_token& stop);

/// Reads, computes and writes meshes. Several threads may call run() at once, each with its own session, unless all
/// results are written to one page.
class MeshRunner {
 public:
  /// The command line must outlive this object.
  MeshRunner(const CommandLine& line, size_t meshCount);

  /// Shows the progress within each mesh on a terminal, unless with --quiet.
  void showProgressOfMeshes() { showsBar_ = !line_.outputs.quiet; }

  /// For --skip-existing: set where the output of an earlier run is up to date. Throws nothing.
  [[nodiscard]] std::optional<MeshRun> skip(const MeshTask& task) const;

  /// Throws nothing: a failure is part of the MeshRun. loaded: set where the mesh was read ahead. A stop request ends
  /// the run with ExitCode::Cancelled. measuresMemory: measure the peak memory of this mesh only; no other mesh may be
  /// computed in this process at the same time.
  [[nodiscard]] MeshRun run(Session& session, const MeshTask& task, std::optional<LoadedMesh> loaded,
                            bool measuresMemory, const std::stop_token& stop);

  /// The run of a mesh whose worker process ended without an answer.
  [[nodiscard]] MeshRun failedRun(const MeshTask& task, const Failure& failure) const;

 private:
  struct SharedPage {
    Page page = emptyPage();
    size_t awaitedCount = 0;  ///< Results that are not computed yet.
    bool isFinished = false;
  };

  [[nodiscard]] MeshRecord recordOf(const MeshTask& task) const;
  void compute(Session& session, const MeshTask& task, const Computation& computation, LoadedMesh& loaded,
               SharedPage* page, const std::stop_token& stop, MeshRun& run) const;
  void writeOutput(const MeshOutcome& outcome, const Mesh& mesh, SharedPage* page, const std::stop_token& stop) const;
  /// Where the record cannot be written, the mesh fails and has no result.
  void writeRecord(const MeshTask& task, MeshRun& run) const;
  void finishPage(const std::string& output, SharedPage& page) const;
  void describe(const MeshTask& task, const MeshOutcome& outcome, MeshRun& run) const;
  void addFailure(const MeshTask& task, const Failure& failure, MeshRun& run) const;

  const CommandLine& line_;
  bool showsBar_ = false;
  std::string optionsHash_;
  SharedJson options_;
  std::optional<SharedPage> onePage_;  ///< Of all meshes.
};

/// For tests that inject faults: called with the input before a mesh is computed. Null otherwise.
extern void (*beforeMesh)(const std::string& input);

}  // namespace asdfvk
