#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Bits of findCrossedFaces().
inline constexpr uint8_t kCrossedByOther = 1, kCrossedBySame = 2;

/// #F, kCrossedByOther where an edge of a face of another solid crosses the face, or one of its edges crosses such a
/// face; kCrossedBySame likewise for faces of the same solid. solidOf: #F. Faces that share a
/// point do not cross, nor do faces that touch: the ends of the edge are farther than minDepth, normalised, from the
/// plane on both sides. Throws Error{Cancelled}.
[[nodiscard]] std::vector<uint8_t> findCrossedFaces(const TraceScene& scene, std::span<const uint32_t> solidOf,
                                                    double minDepth, const RunControl& control);

}  // namespace asdfvk
