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
/// face; kCrossedBySame likewise for faces of the same solid. solidOf: #F. An edge that crosses ends on both sides of
/// the plane, more than minDepth (normalised) from it: faces that touch do not cross, nor do those that share an edge.
/// Throws Error{Cancelled}.
[[nodiscard]] std::vector<uint8_t> findCrossedFaces(const TraceScene& scene, std::span<const uint32_t> solidOf,
                                                    double minDepth, const RunControl& control);

}  // namespace asdfvk
