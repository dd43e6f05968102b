#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asdf_vk/mesh.h"
#include "asdf_vk/run_control.h"

namespace asdfvk::bench {

/// Measures lanes as in a batch: threads that share a device that takes no time, each with a session and its share of
/// the CPU threads. Returns a table with a row per number of lanes. Each lane computes `roundCount` meshes after one
/// for warm-up. Empty, with a line that says so, on a CPU device, on which the CPU predicts from hits.
[[nodiscard]] std::string measureLanes(const std::string& device, const Mesh& mesh, double percent,
                                       const std::vector<uint32_t>& laneCounts, uint32_t roundCount,
                                       const RunControl& control);

}  // namespace asdfvk::bench
