#pragma once

#include <cstdint>
#include <vector>

#include "asdf_vk/run_control.h"
#include "segment/part_surface.h"

namespace asdfvk {

inline constexpr uint32_t kNoLabel = 0xffffffff;
inline constexpr double kCutReach = 0.0577350269189626;  ///< sqrt(1 / 300)

/// Moves the boundaries between labels to concave edges and shortens the boundaries. Uses a graph cut over the faces
/// within kCutReach of another label; docs/segmentation.md has the energy. Distances are along PartSurface::arcs. After
/// the cut, loose pieces take the neighbouring label with the longest common boundary, so that each label is connected.
/// Every label keeps a face. Precondition: each label is connected. labels: #F, below labelCount; faces with kNoLabel
/// are ignored and keep this label. Throws Error{Cancelled} between expansions.
[[nodiscard]] std::vector<uint32_t> cutBoundaries(const PartSurface& surface, std::vector<uint32_t> labels,
                                                  uint32_t labelCount, const RunControl& control = {});

}  // namespace asdfvk
