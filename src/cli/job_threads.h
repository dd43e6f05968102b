#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "cli/batch_monitor.h"
#include "cli/job_plan.h"

namespace asdfvk {

/// Computes the meshes in this process, each job with a session of its own, which is opened anew where its device
/// fails. With one job, the next mesh is read while one is computed. session: for the first job of the first phase. A
/// stop request ends the run after the meshes at hand, which are dropped. Throws what the monitor throws, and Error of
/// kind Device where the device of a session that failed cannot be opened again.
void runOnThreads(const CommandLine& line, MeshRunner& runner, BatchMonitor& monitor,
                  const std::vector<MeshTask>& tasks, const std::vector<JobPhase>& phases,
                  std::unique_ptr<Session> session, const std::stop_token& stop);

/// Opens a session whose CPU device, if it has one, uses that many threads.
[[nodiscard]] std::unique_ptr<Session> openSession(const CommandLine& line, uint32_t threadCount);

}  // namespace asdfvk
