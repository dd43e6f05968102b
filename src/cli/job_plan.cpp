#include "cli/job_plan.h"

#include <algorithm>
#include <utility>

namespace asdfvk {

std::vector<JobPhase> planJobs(const std::vector<MeshTask>& tasks, std::vector<size_t> computed, uint32_t requestedJobs,
                               uint32_t threadCount) {
  if (computed.empty()) return {};
  const auto phaseOf = [&](std::vector<size_t> indices, uint64_t jobs) {
    const auto jobCount = static_cast<uint32_t>(std::clamp<uint64_t>(jobs, 1, indices.size()));
    return JobPhase{std::move(indices), jobCount, std::max(1U, threadCount / jobCount)};
  };
  if (requestedJobs > 0) return {phaseOf(std::move(computed), requestedJobs)};
  std::vector<size_t> small, large;
  for (const size_t i : computed)
    (tasks[i].byteCount <= kSmallMeshBytes && tasks[i].input != "-" ? small : large).push_back(i);
  const uint64_t jobs = std::min<uint64_t>(threadCount, small.size() / kMinMeshesPerJob);
  if (jobs < 2) return {phaseOf(std::move(computed), 1)};
  std::vector<JobPhase> phases;
  if (!large.empty()) phases.push_back(phaseOf(std::move(large), 1));
  phases.push_back(phaseOf(std::move(small), jobs));
  return phases;
}

uint32_t jobsOn(const JobPhase& phase, bool isCpu, uint32_t requestedJobs) {
  return isCpu || requestedJobs > 0 ? phase.jobCount : std::min(phase.jobCount, kMaxJobsOnGpu);
}

uint32_t threadsOn(const JobPhase& phase, bool isCpu, uint32_t requestedJobs) {
  return phase.threadCount * phase.jobCount / jobsOn(phase, isCpu, requestedJobs);
}

}  // namespace asdfvk
