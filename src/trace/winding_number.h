#pragma once

#include <span>

#include "core/vec3.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// How often the faces of closed surfaces wind around a point: 1 inside of a solid, 2 where two solids overlap, -1
/// inside of a solid that is wound inwards. weights: #F, for each representative the number of its copies that count;
/// 0 for any other face. point: normalised, in the box of the mesh or near it. Rays count signed crossings until two or
/// more agree. A ray that passes near an edge, or along a face, is replaced by another one. The directions are fixed.
[[nodiscard]] int windingNumberAt(const TraceScene& scene, std::span<const uint32_t> weights, const Vec3d& point);

}  // namespace asdfvk
