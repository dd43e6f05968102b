#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Bits of findCrossedFaces().
inline constexpr uint8_t kCrossedByOther = 1, kCrossedBySame = 2;

/// Returns #F. Two faces cross where an edge of one crosses the other. kCrossedByOther: a face of another solid crosses
/// the face; kCrossedBySame: a face of the same solid does. solidOf: #F. The two ends of a crossing edge are on
/// different sides of the plane of the face, more than minDepth (normalised) from it, so that faces that touch do not
/// cross. Faces that share an edge do not cross either. Throws Error{Cancelled}.
[[nodiscard]] std::vector<uint8_t> findCrossedFaces(const TraceScene& scene, std::span<const uint32_t> solidOf,
                                                    double minDepth, const RunControl& control);

}  // namespace asdfvk
