#pragma once

#include <cstdint>
#include <vector>

#include "cli/mesh_run.h"

namespace asdfvk {

/// Meshes that are computed in the same way.
struct JobPhase {
  std::vector<size_t> tasks;  ///< Indices.
  uint32_t jobCount = 1;      ///< Meshes at once.
  uint32_t threadCount = 1;   ///< CPU threads of each.
};

/// Files up to this size are small meshes.
inline constexpr uint64_t kSmallMeshBytes = uint64_t{16} << 20;
/// Each job opens a device, which takes as long as some small meshes.
inline constexpr uint64_t kMinMeshesPerJob = 4;
/// Jobs on one GPU where --jobs is not given. An estimate: no GPU was available to measure it.
inline constexpr uint32_t kMaxJobsOnGpu = 4;

/// computed: indices of the tasks to plan; each of them is in exactly one phase. requestedJobs: the value of --jobs, or
/// 0 to choose by the sizes of the meshes. With 0 large meshes are computed first, one after another with all threads.
/// Small meshes follow, in as many jobs as there are threads, but with at least kMinMeshesPerJob meshes per job. If
/// that gives one job only, all meshes are computed one after another in their order.
[[nodiscard]] std::vector<JobPhase> planJobs(const std::vector<MeshTask>& tasks, std::vector<size_t> computed,
                                             uint32_t requestedJobs, uint32_t threadCount);

/// Jobs of the phase on a device, and the threads of each; requestedJobs as above.
[[nodiscard]] uint32_t jobsOn(const JobPhase& phase, bool isCpu, uint32_t requestedJobs);
[[nodiscard]] uint32_t threadsOn(const JobPhase& phase, bool isCpu, uint32_t requestedJobs);

}  // namespace asdfvk
