#pragma once

#include <stop_token>
#include <vector>

#include "cli/batch_monitor.h"

namespace asdfvk {

/// What all jobs of a run share. The members must outlive this object.
struct JobContext {
  const CommandLine& line;
  const std::vector<MeshTask>& tasks;
  MeshRunner& runner;
  BatchMonitor& monitor;
  const std::stop_token& stop;
};

}  // namespace asdfvk
