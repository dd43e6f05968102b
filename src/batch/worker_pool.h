#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/worker_process.h"

namespace asdfvk {

struct WorkerPoolOptions {
  std::string program;
  std::vector<std::string> arguments;  ///< The first one is the name that the process sees.
  std::string greeting;       ///< The first message to each worker. It answers with a message when it is ready.
  uint32_t workerCount = 1;   ///< At most.
  double startSeconds = 300;  ///< Time to answer the greeting. Opening a device can take minutes.
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Time to answer a job.
  uint64_t memoryBytes = 0;                                         ///< Resident memory of a worker; 0: no limit.
  double graceSeconds = 10;  ///< Time after a stop request in which workers may answer current jobs.
};

enum class JobEnd {
  Answered,
  Crashed,         ///< The worker ended without an answer.
  Terminated,      ///< Another process ended the worker by a signal. Set by the engine.
  TimedOut,        ///< The worker was killed after timeoutSeconds.
  MemoryExceeded,  ///< The worker was killed because its memory exceeded memoryBytes.
  Dropped,         ///< After a stop request the worker ended without an answer, or was killed after graceSeconds.
};

struct JobOutcome {
  size_t job = 0;
  JobEnd end = JobEnd::Answered;
  std::string answer;
  ProcessEnd workerEnd;    ///< Not set if answered.
  double seconds = 0;      ///< Since the job was sent.
  uint64_t peakBytes = 0;  ///< Highest memory of the worker that was polled; 0 without a memory limit.
  pid_t worker = 0;
};

/// What the caller of runOnWorkers() provides.
struct WorkerPoolClient {
  /// The message that is sent for a job.
  std::function<std::string(size_t job)> request;
  /// Called with the answer of a worker to the greeting. Returns the maximum number of workers, or 0 if this worker
  /// cannot compute jobs.
  std::function<uint32_t(const std::string& answer)> ready;
  /// Called at the end of each job. Returns whether a worker that answered gets further jobs; else it is replaced.
  std::function<bool(const JobOutcome& outcome)> finished;
};

/// Runs the jobs 0 .. jobCount - 1 in worker processes, one job at a time in each. Jobs begin in the order of their
/// numbers. A worker that crashes or exceeds a limit is replaced, so that only its job fails.
///
/// One worker starts first, the others start when it is ready. A worker is given up, that is, not replaced, if
/// client.ready() returns 0 for it, or if it fails to become ready three times in a row. If no worker was ready until
/// then, all are given up.
///
/// After a stop request no job begins, and workers with a job are sent SIGTERM. Returns when all jobs have ended,
/// when all workers are given up, or, after a stop request, when the current jobs have ended. Returns the reason why
/// the last worker could not start, or an empty text. Throws std::system_error where the system starts no worker.
std::string runOnWorkers(size_t jobCount, const WorkerPoolOptions& options, const WorkerPoolClient& client,
                         const std::stop_token& stop);

}  // namespace asdfvk
