#pragma once

#include <functional>
#include <memory>

#include "batch/job.h"
#include "batch/messages.h"

namespace asdfvk {

/// Runs a worker process: computes the jobs that arrive on its standard input, a socket, until the socket is closed or
/// the computer is spent. The process is killed when its parent ends. Its standard output becomes standard error, so
/// that texts that a library prints are no answers. open: throws OpenFailure, which is sent and ends the worker.
void serveJobs(const std::function<std::unique_ptr<JobComputer>(const Greeting&)>& open);

}  // namespace asdfvk
