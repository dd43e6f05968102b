#pragma once

#include <cstdint>
#include <vector>

#include "asdf_vk/run_control.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// #F, 1 where an edge of another face crosses the face, or one of its edges crosses another face. Faces that share a
/// point do not cross, nor do faces that touch: the ends of the edge are farther than minDepth, normalised, from the
/// plane on both sides. Throws Error{Cancelled}.
[[nodiscard]] std::vector<uint8_t> findCrossedFaces(const TraceScene& scene, double minDepth,
                                                    const RunControl& control);

}  // namespace asdfvk
