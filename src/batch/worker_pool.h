#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "batch/worker_process.h"

namespace asdfvk {

struct WorkerPoolOptions {
  std::string program;
  std::vector<std::string> arguments;  ///< The first one is argv[0].
  std::string greeting;       ///< First message to each worker. The worker answers with a message when it is ready.
  uint32_t workerCount = 1;   ///< Greatest number of workers.
  double startSeconds = 300;  ///< Time limit for the answer to the greeting. Opening a device can take minutes.
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Time limit for the answer to a job.
  uint64_t memoryBytes = 0;  ///< Limit of the resident memory of a worker; 0: no limit.
  double graceSeconds = 10;  ///< Time after a stop request during which workers may answer current jobs.
};

enum class JobEnd {
  Answered,
  Crashed,         ///< The worker ended without an answer.
  Terminated,      ///< Another process ended the worker by a signal. Only the engine sets this value.
  TimedOut,        ///< The worker was killed after timeoutSeconds.
  MemoryExceeded,  ///< The worker was killed because its memory exceeded memoryBytes.
  Dropped,         ///< After a stop request, the worker ended without an answer or was killed after graceSeconds.
};

struct JobOutcome {
  size_t job = 0;
  JobEnd end = JobEnd::Answered;
  std::string answer;
  ProcessEnd workerEnd;    ///< How the worker ended; not set for Answered.
  double seconds = 0;      ///< Time since the job was sent.
  uint64_t peakBytes = 0;  ///< Peak of the polled memory of the worker; 0 without a memory limit.
  pid_t worker = 0;
  uint32_t attempt = 1;  ///< 2 for a job that was tried again.
};

/// Which jobs a pool can begin.
struct JobSupply {
  enum class State { Ready, Later, Ended };

  /// The jobs 0 .. count - 1.
  JobSupply(size_t count) : next([count](size_t job) { return job < count ? State::Ready : State::Ended; }) {}
  /// Jobs that arrive later. arrival: a descriptor for poll() that is readable when next() may have changed.
  JobSupply(std::function<State(size_t job)> nextJob, int arrival) : next(std::move(nextJob)), descriptor(arrival) {}

  std::function<State(size_t job)> next;  ///< Whether the job can begin. Called with the jobs in their order.
  int descriptor = -1;                    ///< -1: none.
};

struct WorkerPoolClient {
  std::function<std::string(size_t job, uint32_t attempt)> request;
  /// Called with a worker's answer to the greeting. Returns the greatest number of workers; 0 if the worker cannot
  /// compute.
  std::function<uint32_t(const std::string& answer)> ready;
  /// Called at the end of each job. Returns whether a worker that answered gets further jobs instead of being replaced.
  std::function<bool(const JobOutcome& outcome)> finished;
  /// Called instead of finished() for a job that will be tried again; may be null.
  std::function<void(const JobOutcome& outcome)> retried = {};
};

/// Runs the jobs 0, 1, ... in worker processes. Each worker runs one job at a time. Jobs begin in the order of
/// their numbers. A worker that crashes or exceeds a limit is replaced, so that only its current job fails.
///
/// A job whose worker was killed for its memory, by memoryBytes or by SIGKILL of the system, is tried once more when
/// no other job can begin: in a new worker, while no other worker exists. If this attempt does not begin, the first one
/// counts; after a stop request the job is then Dropped.
///
/// One worker starts first. The other workers start when the first one is ready. A worker is given up (no longer
/// replaced) if client.ready() returns 0, or if three consecutive starts of the worker fail. If no worker was ready
/// before, all workers are given up.
///
/// After a stop request no job begins, and workers with a job receive SIGTERM. Returns when all jobs have ended, when
/// all workers are given up, or, after a stop request, when the current jobs have ended. Returns the reason of the
/// latest failed start after which a worker was given up, or an empty text. Throws std::system_error if the system
/// cannot start any worker.
std::string runOnWorkers(const JobSupply& jobs, const WorkerPoolOptions& options, const WorkerPoolClient& client,
                         const std::stop_token& stop);

}  // namespace asdfvk
