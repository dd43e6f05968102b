#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
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
  ~BatchMonitor();
  BatchMonitor(const BatchMonitor&) = delete;
  BatchMonitor& operator=(const BatchMonitor&) = delete;

  /// The rate counts from now. Meshes that were added before are those of earlier runs.
  void beginComputation();

  /// Prints the device lines of the first session that is opened.
  void announce(const std::string& backend, const std::string& deviceLines);

  /// Prints lines unless with --quiet.
  void note(const std::string& lines);

  /// Throws Error{OutputNotWritable} for the log and standard output.
  void add(size_t task, MeshRun run);

  /// Prints what is left and the summary of a batch. Returns the exit code of the meshes.
  [[nodiscard]] ExitCode finish();

  /// Whether meshes were dropped or not begun.
  [[nodiscard]] bool hasUnfinished() const;

 private:
  struct Texts {
    std::string json, text;
  };

  void noteOtherBackend(MeshRun& run, const std::string& input);
  void print(const Texts& texts);
  void printInOrder();
  void showProgress();
  void wipeProgress();
  [[nodiscard]] double firstProgressSeconds() const { return isTerminal_ ? 1 : 10; }

  const CommandLine& line_;
  const std::vector<MeshTask>& tasks_;
  mutable std::mutex mutex_;
  std::optional<RecordLog> log_;
  std::vector<std::optional<Texts>> waiting_;  ///< Until all earlier meshes are printed.
  size_t nextPrinted_ = 0;
  BatchProgress progress_;
  SharedExitCode code_;
  std::vector<std::string> dropped_;
  std::set<std::string> announcedBackends_;
  Stopwatch watch_;
  double nextProgressSeconds_ = 0;
  bool isTerminal_, isProgressVisible_ = false;
  std::condition_variable_any wakesTicker_;
  std::jthread ticker_;  ///< Shows the progress also while no mesh ends. The last member: it uses the others.
};

}  // namespace asdfvk
