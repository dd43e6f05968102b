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
  std::string greeting;                ///< The first line to each worker, which answers with a line when it is ready.
  uint32_t workerCount = 1;            ///< At most.
  double startSeconds = 300;           ///< From the greeting to its answer: opening a device may compile for minutes.
  double timeoutSeconds = std::numeric_limits<double>::infinity();  ///< Per task, from its sending to the answer.
  uint64_t memoryBytes = 0;                                         ///< Resident memory of a worker; 0: no limit.
  double graceSeconds = 10;  ///< After a stop request, for the answers to the tasks at hand.
};

enum class TaskEnd {
  Answered,
  Crashed,         ///< The worker ended without an answer.
  TimedOut,        ///< The worker was killed.
  MemoryExceeded,  ///< The worker was killed.
  Dropped,         ///< Stop request; the worker gave no answer within the grace time.
};

struct TaskOutcome {
  size_t task = 0;
  TaskEnd end = TaskEnd::Answered;
  std::string answer;
  ProcessEnd workerEnd;    ///< Unless answered.
  double seconds = 0;      ///< Since the task was sent.
  uint64_t peakBytes = 0;  ///< Of the worker, as far as it was observed; 0 without a memory limit.
  pid_t worker = 0;
};

/// The program that distributes tasks to worker processes, one at a time to each. A worker that crashes, hangs or grows
/// beyond the limit is replaced, so that a task can only fail itself.
struct WorkerPoolClient {
  /// The line that is sent for a task.
  std::function<std::string(size_t task)> request;
  /// Takes the answer of a worker to the greeting. Returns how many workers may exist; 0: this one is of no use.
  std::function<uint32_t(const std::string& answer)> ready;
  /// Returns whether a worker that answered takes further tasks; else it is replaced.
  std::function<bool(const TaskOutcome& outcome)> finished;
};

/// Runs the tasks 0 .. taskCount - 1, which begin in this order. Further workers start when one is ready. Workers that
/// are of no use, or end or hang three times in a row before they are ready, are not replaced. Returns without having
/// run all tasks where no worker is left, and after a stop request: then workers are sent SIGTERM, and no task begins.
/// Returns why the last worker could not start, or nothing.
std::string runOnWorkers(size_t taskCount, const WorkerPoolOptions& options, const WorkerPoolClient& client,
                         const std::stop_token& stop);

}  // namespace asdfvk
