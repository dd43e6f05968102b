#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace asdfvk {

/// The Euclidean minimum spanning tree of points: pairs of point indices, one pair fewer than points. Borůvka's
/// algorithm. A k-d tree finds the nearest point of another group; the search skips nodes whose points are all of the
/// same group (March, Ram and Gray 2010: Fast Euclidean Minimum Spanning Tree). Precondition: the points are finite.
[[nodiscard]] std::vector<std::array<uint32_t, 2>> minimumSpanningTree(std::span<const Vec3d> points);

}  // namespace asdfvk
