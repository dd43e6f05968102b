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

/// Jobs that are computed in the same way.
struct JobPhase {
  std::vector<size_t> jobs;  ///< Indices.
  uint32_t atOnce = 1;       ///< Jobs that are computed at the same time.
  uint32_t threadCount = 1;  ///< CPU threads of each.
};

/// Files up to this size are small meshes.
inline constexpr uint64_t kSmallMeshBytes = uint64_t{16} << 20;
/// Each worker opens a device, which takes as long as some small meshes: these, and files of this size with
/// kBytesPerMesh for each mesh.
inline constexpr uint64_t kMinMeshesPerWorker = 4, kMinBytesPerWorker = uint64_t{1} << 20;
/// Workers on one GPU where their number is not requested. An estimate: no GPU was available to measure it.
inline constexpr uint32_t kMaxWorkersOnGpu = 4;

/// pending: indices of the jobs to plan; each of them is in exactly one phase. requested: jobs at once, or 0 to choose
/// by the sizes of the meshes. With 0 large meshes are computed first, one after another with all threads. Small meshes
/// follow, by as many workers as there are threads, but with at least kMinMeshesPerWorker and kMinBytesPerWorker per
/// worker. If that gives one worker only, all meshes are computed one after another in their order. Streams are never
/// computed at the same time as others.
[[nodiscard]] std::vector<JobPhase> planJobs(const std::vector<Job>& jobs, std::vector<size_t> pending,
                                             uint32_t requested, uint32_t threadCount);

struct EngineOptions {
  uint32_t requestedAtOnce = 0;                                     ///< Jobs at once; 0: chosen by planJobs().
  uint32_t threadCount = 1;                                         ///< CPU threads of all jobs together.
  bool isolates = false;                                            ///< All jobs are computed in workers.
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Time of a job in a worker.
  uint64_t memoryBytes = 0;                                         ///< Memory of a worker; 0: no limit.
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
