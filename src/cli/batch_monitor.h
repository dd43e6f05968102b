#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "batch/progress.h"
#include "batch/record_log.h"
#include "cli/mesh_run.h"
#include "core/stopwatch.h"

namespace asdfvk {

/// Takes the results of meshes in any order and from any thread: prints them in the order of the meshes, appends to the
/// log, shows the progress of a batch, and finds the exit code.
class BatchMonitor {
 public:
  /// Opens the log. Throws Error{OutputNotWritable}. The arguments must outlive this object.
  BatchMonitor(const CommandLine& line, const std::vector<MeshTask>& tasks);

  /// Throws Error{OutputNotWritable} for the log and standard output.
  void add(size_t task, MeshRun run);

  /// Prints what is left and the summary of a batch. Returns the exit code.
  [[nodiscard]] ExitCode finish();

 private:
  struct Texts {
    std::string json, text;
  };

  void print(const Texts& texts);
  void printInOrder();
  void showProgress();
  void wipeProgress();

  const CommandLine& line_;
  const std::vector<MeshTask>& tasks_;
  std::mutex mutex_;
  std::optional<RecordLog> log_;
  std::vector<std::optional<Texts>> waiting_;  ///< Until all earlier meshes are printed.
  size_t nextPrinted_ = 0;
  BatchProgress progress_;
  SharedExitCode code_;
  std::vector<std::string> dropped_;
  Stopwatch watch_;
  double nextProgressSeconds_;
  bool isTerminal_, isProgressVisible_ = false;
};

}  // namespace asdfvk
