#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

namespace asdfvk {

struct WorkerPoolOptions {
  std::vector<std::string> command;  ///< Program and arguments.
  std::string greeting;              ///< The first line to each worker, which answers with a line when it is ready.
  uint32_t workerCount = 1;
  double startSeconds = 300;  ///< From the greeting to its answer: opening a device may compile for minutes.
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
  std::string text;        ///< The answer, or how a worker that crashed ended.
  double seconds = 0;      ///< Since the task was sent.
  uint64_t peakBytes = 0;  ///< Of the worker, as far as it was observed; 0 without a memory limit.
  pid_t worker = 0;
};

/// The program that calls this distributes tasks to worker processes, one at a time to each, and replaces a worker that
/// crashes, hangs or grows beyond the limit, so that a task can only fail itself.
struct WorkerPoolClient {
  /// The line that is sent for a task.
  std::function<std::string(size_t task)> request;
  /// The answer to the greeting of each worker. Returns false to end the run.
  std::function<bool(const std::string& answer)> ready;
  std::function<void(const TaskOutcome& outcome)> finished;
};

/// Runs the tasks 0 .. taskCount - 1, which begin in this order. Workers are sent SIGTERM at a stop request; then no
/// task begins. Throws std::runtime_error where workers end or hang before they are ready, three times in a row.
void runOnWorkers(size_t taskCount, const WorkerPoolOptions& options, const WorkerPoolClient& client,
                  const std::stop_token& stop);

}  // namespace asdfvk
