#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/job.h"
#include "batch/monitor.h"
#include "batch/worker_pool.h"

namespace asdfvk {

struct EngineOptions {
  uint32_t requestedAtOnce = 0;                                     ///< Jobs at once; 0: chosen by planJobs().
  uint32_t threadCount = 1;                                         ///< CPU threads of all jobs together.
  bool isolates = false;                                            ///< All jobs are computed in workers.
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Of a job in a worker.
  uint64_t memoryBytes = 0;                                         ///< Of a worker; 0: no limit.
};

/// What the front end provides.
struct EngineClient {
  /// The result of an earlier run that is up to date. Called by several threads at once.
  std::function<std::optional<JobResult>(const Job&)> findFinished;
  /// A computer in this process. Throws OpenFailure.
  std::function<std::unique_ptr<JobComputer>()> open;
  /// The result of a job whose worker gave none.
  std::function<JobResult(const Job&, const JobOutcome&)> fail;
  /// Arguments with which this program is a worker, see serveJobs(), and the settings that it gets.
  std::vector<std::string> workerArguments;
  Json workerSettings;
  Json recordOptions;  ///< MeshRecord::options of all jobs.
};

/// Computes the jobs in the order of planJobs(): one after another in this process, several at once in workers. Adds
/// each result to the monitor. A computer whose device failed is replaced.
///
/// After a stop request the current jobs are dropped, and no further job begins. Throws OpenFailure where no device can
/// be opened for the jobs that are left, and what the monitor throws.
void runJobs(const std::vector<Job>& jobs, const EngineOptions& options, const EngineClient& client, Monitor& monitor,
             const std::stop_token& stop);

}  // namespace asdfvk
