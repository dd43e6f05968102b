#pragma once

#include <memory>
#include <vector>

#include "cli/job_context.h"
#include "cli/job_plan.h"

namespace asdfvk {

/// Computes the meshes of the phases in this process. Each job has its own session, which is opened again after its
/// device failed. With one job, the next mesh is read while a mesh is computed. session: for the first job of the first
/// phase. A stop request drops the meshes that are being computed, and no further mesh begins.
///
/// Throws what the monitor throws. Throws the Error of openSession() if the first session of a phase cannot be opened,
/// or if the device of the last job of a phase failed and cannot be opened again.
void runOnThreads(const JobContext& context, const std::vector<JobPhase>& phases, std::unique_ptr<Session> session);

/// Opens a session whose CPU device, if it has one, uses that many threads.
[[nodiscard]] std::unique_ptr<Session> openSession(const CommandLine& line, uint32_t threadCount);

}  // namespace asdfvk
