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

/// A set of jobs, with the number of jobs at once and of threads per job.
struct JobPhase {
  std::vector<size_t> jobs;  ///< Indices of jobs.
  uint32_t atOnce = 1;       ///< Jobs that are computed at the same time.
  uint32_t threadCount = 1;  ///< CPU threads of each job.
};

/// Meshes in files up to this size are small.
inline constexpr uint64_t kSmallMeshBytes = uint64_t{16} << 20;
/// Least work per worker: a number of meshes, and a size of their files plus kBytesPerMesh per mesh. For less work, the
/// start of a worker, which opens a device, takes more time than the worker saves.
inline constexpr uint64_t kMinMeshesPerWorker = 4, kMinBytesPerWorker = uint64_t{1} << 20;
/// Greatest number of workers on one GPU if the caller requests no number. Estimated; not measured on a GPU.
inline constexpr uint32_t kMaxWorkersOnGpu = 4;

/// Assigns each pending job to one phase. pending: indices of the jobs. requested: jobs at once; 0: depends on the
/// sizes of the meshes. With 0, large meshes come first, one after another with all threads. Small meshes follow, with
/// a worker per thread, but at least kMinMeshesPerWorker and kMinBytesPerWorker per worker. If only one worker remains,
/// all meshes are computed one after another in their order. During a stream (Job::isStream), no other job is computed.
[[nodiscard]] std::vector<JobPhase> planJobs(const std::vector<Job>& jobs, std::vector<size_t> pending,
                                             uint32_t requested, uint32_t threadCount);

struct EngineOptions {
  uint32_t requestedAtOnce = 0;                                     ///< Jobs at once; 0: planJobs() chooses.
  uint32_t threadCount = 1;                                         ///< CPU threads of all current jobs together.
  bool isolates = false;                                            ///< Computes all jobs in workers.
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Time limit of a job in a worker.
  uint64_t memoryBytes = 0;                                         ///< Memory limit of a worker; 0: no limit.
};

struct EngineClient {
  /// Returns the result of an earlier run if it is up to date. Must be thread-safe.
  std::function<std::optional<JobResult>(const Job&)> findFinished;
  /// Opens a computer in this process. Throws OpenFailure.
  std::function<std::unique_ptr<JobComputer>()> open;
  /// Returns the result of a job whose worker returned none.
  std::function<JobResult(const Job&, const JobOutcome&)> fail;
  /// Arguments that make this program a worker (serveJobs()), and Greeting::settings of the worker.
  std::vector<std::string> workerArguments;
  Json workerSettings;
  Json recordOptions;  ///< MeshRecord::options for all jobs.
};

/// Computes the jobs in the phases of planJobs(): in worker processes if a phase has several jobs at once, otherwise in
/// this process. Adds each result to the monitor. Replaces a computer whose device failed. A stop request drops the
/// current jobs, and no further job begins. Throws OpenFailure if no device can be opened for the remaining jobs, and
/// the errors of the monitor.
void runJobs(const std::vector<Job>& jobs, const EngineOptions& options, const EngineClient& client, Monitor& monitor,
             const std::stop_token& stop);

}  // namespace asdfvk
