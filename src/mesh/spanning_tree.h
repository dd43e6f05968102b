#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "core/vec3.h"

namespace asdfvk {

/// The Euclidean minimum spanning tree of points, as pairs of point indices. n points give n - 1 pairs. Borůvka's
/// algorithm. A k-d tree finds the nearest point of another group. The search skips nodes whose points all belong to
/// the same group (March, Ram and Gray 2010: Fast Euclidean Minimum Spanning Tree). Throws Error{Cancelled}.
/// Precondition: the points are finite.
[[nodiscard]] std::vector<std::array<uint32_t, 2>> minimumSpanningTree(std::span<const Vec3d> points,
                                                                       const RunControl& control = {});

}  // namespace asdfvk
