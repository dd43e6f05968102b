#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "batch/job.h"
#include "batch/mesh_record.h"
#include "batch/progress.h"
#include "core/stopwatch.h"

namespace asdfvk {

struct MonitorOptions {
  std::string log;             ///< File to which records are appended; empty: none.
  bool printsReports = false;  ///< On standard output.
  bool showsProgress = true;   ///< And a summary.
  bool isQuiet = false;        ///< Prints reports and the messages of jobs only.
};

/// Takes the results of jobs in any order and from any thread: prints them in the order of the jobs, appends to the log
/// and shows the progress.
class Monitor {
 public:
  /// Opens the log. Throws Error{OutputNotWritable}. The jobs must outlive this object.
  Monitor(const MonitorOptions& options, const std::vector<Job>& jobs);
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// The rate counts from now. Results that were added before are those of earlier runs.
  void beginComputation();

  /// Prints the device lines of the first computer.
  void announce(const ComputerDescription& computer);

  /// Prints a warning unless quiet.
  void note(const std::string& message);

  /// Throws Error{OutputNotWritable} for the log and standard output.
  void add(size_t job, JobResult result);

  /// Prints what is left and the summary. To be called once, after the last result.
  void finish();

  /// The exit codes of the added results, in the order in which they were added.
  [[nodiscard]] const std::vector<int>& codes() const { return codes_; }
  /// Jobs without a result, ascending.
  [[nodiscard]] std::vector<size_t> unfinishedJobs() const;
  /// Whether jobs were dropped or not begun.
  [[nodiscard]] bool hasUnfinished() const;

 private:
  struct Texts {
    std::string report, messages;
  };

  void noteOtherBackend(JobResult& result);
  void print(const Texts& texts);
  void printInOrder();
  void showProgress();
  void wipeProgress();
  [[nodiscard]] double firstProgressSeconds() const { return isTerminal_ ? 1 : 10; }

  const MonitorOptions options_;
  const std::vector<Job>& jobs_;
  mutable std::mutex mutex_;
  std::optional<RecordLog> log_;
  std::vector<std::optional<Texts>> waiting_;  ///< Until all earlier jobs are printed.
  std::vector<char> isAdded_;
  size_t nextPrinted_ = 0;
  BatchProgress progress_;
  std::vector<int> codes_;
  std::vector<std::string> dropped_;
  std::set<std::string> announcedBackends_;
  Stopwatch watch_;
  double nextProgressSeconds_ = 0;
  bool isTerminal_, isProgressVisible_ = false;
  std::condition_variable_any wakesTicker_;
  std::jthread ticker_;  ///< Shows the progress also while no mesh ends. The last member: it uses the others.
};

}  // namespace asdfvk
