#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "batch/job.h"

namespace asdfvk {

struct LaneOptions {
  uint32_t laneCount = 1;
  uint32_t threadCount = 1;  ///< CPU threads of each lane if there are several lanes; a single lane has all threads.
};

/// Several lanes call these functions at the same time.
struct LaneClient {
  /// Throws OpenFailure.
  std::function<std::unique_ptr<JobComputer>()> open;
  std::function<void(JobComputer& computer, size_t job)> compute;
};

/// Computes the jobs 0 .. jobCount - 1 in lanes: threads of this process with a JobComputer each, which is replaced
/// when it is spent. Jobs begin in the order of their numbers. The first lane is this thread; the other lanes start
/// when the first one has opened its JobComputer. A lane ends if it cannot open a JobComputer; the other lanes
/// continue.
///
/// After a stop request no job begins. Returns when all current jobs have ended. Returns the last OpenFailure after
/// which the other lanes have computed all jobs; throws it if jobs are left. If compute() throws, no further job
/// begins, and the first such error is thrown.
std::optional<OpenFailure> runInLanes(size_t jobCount, const LaneOptions& options, const LaneClient& client,
                                      const std::stop_token& stop);

}  // namespace asdfvk
