#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// Bits of findCrossedFaces().
inline constexpr uint8_t kCrossedByOther = 1, kCrossedBySame = 2;

/// Returns #F bits. Two faces cross if an edge of one of them passes through the other. kCrossedByOther: a face of
/// another solid crosses the face. kCrossedBySame: a face of the same solid crosses the face. solidOf: #F. Faces that
/// only touch do not cross. The ends of a crossing edge are on different sides of the plane of the face, at distances
/// above minDepth (normalised). Faces that share an edge do not cross. Throws Error{Cancelled}.
[[nodiscard]] std::vector<uint8_t> findCrossedFaces(const TraceScene& scene, std::span<const uint32_t> solidOf,
                                                    double minDepth, const RunControl& control);

}  // namespace asdfvk
