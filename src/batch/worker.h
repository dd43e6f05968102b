#pragma once

#include <functional>
#include <memory>

#include "batch/job.h"

namespace asdfvk {

/// The first message to a worker. settings: those of the front end.
struct Greeting {
  Json settings;
  uint32_t threadCount = 1, threadCountOnGpu = 1;
};
ASDFVK_JSON(Greeting, settings, threadCount, threadCountOnGpu)

/// Runs a worker process: computes the jobs that arrive on its standard input, a socket, until the socket is closed or
/// the computer is spent. The process is killed when its parent ends. Its standard output becomes standard error, so
/// that texts that a library prints are no answers. open: throws OpenFailure, which is sent and ends the worker.
void serveJobs(const std::function<std::unique_ptr<JobComputer>(const Greeting&)>& open);

}  // namespace asdfvk
