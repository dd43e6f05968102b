#pragma once

#include <condition_variable>
#include <map>
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
  std::string log;             ///< Path of the log, to which records are appended; empty: none.
  bool printsReports = false;  ///< Prints JobResult::report on standard output.
  bool showsProgress = true;   ///< Shows the progress and a summary.
  bool keepsRecords = false;   ///< Keeps the records for Monitor::records().
  bool isCheck = false;        ///< See BatchProgress.
  bool isQuiet = false;        ///< Prints only the reports and messages of jobs.
};

/// Receives results of jobs in any order from any thread. Prints and logs them in the order of the jobs.
class Monitor {
 public:
  /// Opens the log. jobs: empty for a stream, whose jobs have the numbers 0, 1, ... Throws Error{OutputNotWritable}.
  /// Precondition: `jobs` outlives this object.
  Monitor(const MonitorOptions& options, const std::vector<Job>& jobs);
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// Starts the clock of the rate and the summary. Precondition: the results of earlier runs were added.
  void beginComputation();

  /// Prints the device lines of the first JobComputer; later calls print nothing.
  void announce(const ComputerDescription& computer);

  void note(const std::string& message);

  /// Adds the result of a job. Throws Error{OutputNotWritable} if the log or standard output cannot be written.
  void add(size_t job, JobResult result);

  /// Prints the remaining texts and the summary. Preconditions: all results were added; this is the first call.
  void finish();

  /// The records of the jobs with a result, in the order of the jobs. Precondition: MonitorOptions::keepsRecords.
  [[nodiscard]] std::vector<MeshRecord> records() const;
  /// The codes that jobs have.
  [[nodiscard]] const std::set<int>& codes() const { return codes_; }
  [[nodiscard]] std::vector<size_t> unfinishedJobs() const;
  /// Whether jobs were dropped or have no result.
  [[nodiscard]] bool hasUnfinished() const;

 private:
  struct Texts {
    std::string report, messages;
  };

  void noteOtherBackend(JobResult& result);
  void noteSecondAttempt(JobResult& result) const;
  void print(const Texts& texts);
  void printInOrder();
  void showProgress();
  void wipeProgress();
  [[nodiscard]] double firstProgressSeconds() const { return isTerminal_ ? 1 : 10; }

  const MonitorOptions options_;
  const std::vector<Job>& jobs_;
  mutable std::mutex mutex_;
  std::optional<RecordLog> log_;
  std::map<size_t, Texts> waiting_;  ///< Texts of jobs that wait until all earlier jobs are printed.
  size_t nextPrinted_ = 0;
  BatchProgress progress_;
  std::set<int> codes_;
  std::map<size_t, MeshRecord> records_;  ///< By job.
  std::vector<std::string> dropped_;
  std::set<std::string> announcedBackends_;
  Stopwatch watch_;
  double nextProgressSeconds_ = 0;
  bool isTerminal_, isProgressVisible_ = false;
  std::condition_variable_any wakesTicker_;
  /// Shows the progress between results. Last member, because the thread uses the other members.
  std::jthread ticker_;
};

}  // namespace asdfvk
