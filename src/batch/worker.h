#pragma once

#include <functional>
#include <memory>

#include "batch/job.h"

namespace asdfvk {

struct Greeting {
  Json settings;  ///< EngineClient::workerSettings.
  uint32_t threadCount = 1, threadCountOnGpu = 1;
};
ASDFVK_JSON(Greeting, settings, threadCount, threadCountOnGpu)

/// Runs this process as a worker. Computes jobs that arrive on standard input, which is a socket. Returns when the
/// socket is closed or JobComputer::isSpent() is true. The process is killed when its parent ends. Standard output is
/// redirected to standard error, because output of a library would be read as an answer. open: opens the computer. An
/// OpenFailure is sent as the answer and ends the worker.
void serveJobs(const std::function<std::unique_ptr<JobComputer>(const Greeting&)>& open);

}  // namespace asdfvk
