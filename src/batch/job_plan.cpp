#include "batch/job_plan.h"

#include <algorithm>
#include <utility>

#include "batch/input_list.h"

namespace asdfvk {

std::vector<JobPhase> planJobs(const std::vector<Job>& jobs, std::vector<size_t> pending, uint32_t requested,
                               uint32_t threadCount) {
  if (pending.empty()) return {};
  const auto phaseOf = [&](std::vector<size_t> indices, uint64_t count) {
    const auto atOnce = static_cast<uint32_t>(std::clamp<uint64_t>(count, 1, indices.size()));
    return JobPhase{std::move(indices), atOnce, std::max(1U, threadCount / atOnce)};
  };
  if (requested == 1) return {phaseOf(std::move(pending), 1)};
  const auto isAlone = [&](size_t i) {
    return jobs[i].isStream || (requested == 0 && jobs[i].byteCount > kSmallMeshBytes);
  };
  std::vector<size_t> alone, together;
  for (const size_t i : pending) (isAlone(i) ? alone : together).push_back(i);
  uint64_t byteCount = kBytesPerMesh * together.size();
  for (const size_t i : together) byteCount += jobs[i].byteCount;
  const uint64_t count =
      requested > 0
          ? requested
          : std::min({uint64_t{threadCount}, together.size() / kMinMeshesPerWorker, byteCount / kMinBytesPerWorker});
  if (count < 2 || together.empty()) return {phaseOf(std::move(pending), 1)};
  std::vector<JobPhase> phases;
  if (!alone.empty()) phases.push_back(phaseOf(std::move(alone), 1));
  phases.push_back(phaseOf(std::move(together), count));
  return phases;
}

}  // namespace asdfvk
