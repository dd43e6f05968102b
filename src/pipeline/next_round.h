#pragma once

#include <cstdint>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"

namespace asdfvk {

/// Number of further seeds with which the estimated errors probably fulfil the options; 0 if they do, or if no node is
/// left. errors: null if there is no estimate. traceableCount: number of all nodes that can cast rays.
[[nodiscard]] uint64_t furtherSeedCount(const RoundOptions& options, const ErrorEstimate* errors, uint64_t seedCount,
                                        uint64_t traceableCount);

}  // namespace asdfvk
