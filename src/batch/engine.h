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

/// Jobs that are computed with the same number of concurrent jobs and of threads per job.
struct JobPhase {
  std::vector<size_t> jobs;  ///< Indices of jobs.
  uint32_t atOnce = 1;       ///< Jobs that are computed at the same time.
  uint32_t threadCount = 1;  ///< CPU threads of each job.
};

/// Meshes in files up to this size are small.
inline constexpr uint64_t kSmallMeshBytes = uint64_t{16} << 20;
/// Least work per worker: number of meshes, and total size of their files with kBytesPerMesh added per mesh. A worker
/// opens a device at its start. For less work, the start takes more time than the worker saves.
inline constexpr uint64_t kMinMeshesPerWorker = 4, kMinBytesPerWorker = uint64_t{1} << 20;
/// Greatest number of lanes or workers on one GPU if the caller requests no number. Estimated; not measured on a GPU.
inline constexpr uint32_t kMaxLanesOnGpu = 4;

/// Assigns each pending job to one phase. pending: indices of the jobs. requested: number of concurrent jobs; 0: the
/// sizes of the meshes decide. With 0, the first phase has the large meshes, one after another with all threads. The
/// second phase has the small meshes, with one worker per thread, or with fewer workers so that each has on
/// average at least kMinMeshesPerWorker and kMinBytesPerWorker. If this rule leaves only one worker, all meshes are
/// computed one after another in their order. While a stream (Job::isStream) is computed, no other job is computed.
[[nodiscard]] std::vector<JobPhase> planJobs(const std::vector<Job>& jobs, std::vector<size_t> pending,
                                             uint32_t requested, uint32_t threadCount);

/// Jobs that arrive while others are computed. One thread calls the functions.
class JobStream {
 public:
  virtual ~JobStream() = default;
  /// See JobSupply.
  [[nodiscard]] virtual JobSupply::State next() = 0;
  [[nodiscard]] virtual int descriptor() const = 0;
  /// Returns the next job. Called once for each job, with the numbers 0, 1, ...
  [[nodiscard]] virtual Job take(size_t index) = 0;
  /// Receives the results, in any order.
  virtual void add(size_t index, JobResult result) = 0;
};

struct EngineOptions {
  uint32_t requestedAtOnce = 0;  ///< Number of concurrent jobs; 0: planJobs() chooses.
  uint32_t threadCount = 1;      ///< Sum of the CPU threads of all concurrent jobs.
  bool isolates = false;         ///< Computes all jobs in workers.
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Time limit of a job in a worker.
  uint64_t memoryBytes = 0;                                         ///< Memory limit of a worker; 0: no limit.
};

struct EngineClient {
  /// Returns the result of an earlier run if this result is up to date. Must be thread-safe.
  std::function<std::optional<JobResult>(const Job&)> findFinished;
  /// Opens a JobComputer in this process. Throws OpenFailure. Must be thread-safe after shareDevice() returned true.
  std::function<std::unique_ptr<JobComputer>()> open;
  /// Prepares open() for this number of JobComputers that compute at the same time in this process. Returns false, also
  /// where it is null, if worker processes compute faster.
  std::function<bool(uint32_t count)> shareDevice;
  /// Returns the result of a job whose worker returned none.
  std::function<JobResult(const Job&, const JobOutcome&)> fail;
  /// Arguments that make this program a worker (serveJobs()), and Greeting::settings of the worker.
  std::vector<std::string> workerArguments;
  Json workerSettings;
  Json recordOptions;  ///< MeshRecord::options for all jobs.
};

/// Computes the jobs in the phases of planJobs(). A phase with several jobs at once runs in lanes (runInLanes()) if
/// EngineClient::shareDevice() allows them, and otherwise in worker processes. With EngineOptions::isolates, all phases
/// run in worker processes. Any other phase runs in this process, one job after another. Adds each result to the
/// monitor. Replaces a JobComputer whose device failed. A stop request drops the current jobs, and no further job
/// begins. Throws OpenFailure if no device can be opened for the remaining jobs, and the errors of the monitor.
void runJobs(const std::vector<Job>& jobs, const EngineOptions& options, const EngineClient& client, Monitor& monitor,
             const std::stop_token& stop);

/// Computes the jobs of the stream in worker processes: EngineOptions::requestedAtOnce of them, or one per thread.
/// EngineClient::findFinished and shareDevice are not used. A stop request drops the current jobs. Throws OpenFailure
/// if no device can be opened for the remaining jobs, and the errors of the stream and the monitor.
void runStream(JobStream& stream, const EngineOptions& options, const EngineClient& client, Monitor& monitor,
               const std::stop_token& stop);

}  // namespace asdfvk
