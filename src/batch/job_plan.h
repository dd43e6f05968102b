#pragma once

#include <cstdint>
#include <vector>

#include "batch/job.h"

namespace asdfvk {

/// Jobs that are computed in the same way.
struct JobPhase {
  std::vector<size_t> jobs;  ///< Indices.
  uint32_t atOnce = 1;       ///< Jobs that are computed at the same time.
  uint32_t threadCount = 1;  ///< CPU threads of each.
};

/// Files up to this size are small meshes.
inline constexpr uint64_t kSmallMeshBytes = uint64_t{16} << 20;
/// Each worker opens a device, which takes as long as some small meshes: these, and files of this size with
/// kBytesPerMesh for each mesh.
inline constexpr uint64_t kMinMeshesPerWorker = 4, kMinBytesPerWorker = uint64_t{1} << 20;
/// Workers on one GPU where their number is not requested. An estimate: no GPU was available to measure it.
inline constexpr uint32_t kMaxWorkersOnGpu = 4;

/// pending: indices of the jobs to plan; each of them is in exactly one phase. requested: jobs at once, or 0 to choose
/// by the sizes of the meshes. With 0 large meshes are computed first, one after another with all threads. Small meshes
/// follow, by as many workers as there are threads, but with at least kMinMeshesPerWorker and kMinBytesPerWorker per
/// worker. If that gives one worker only, all meshes are computed one after another in their order. Streams are never
/// computed at the same time as others.
[[nodiscard]] std::vector<JobPhase> planJobs(const std::vector<Job>& jobs, std::vector<size_t> pending,
                                             uint32_t requested, uint32_t threadCount);

}  // namespace asdfvk
