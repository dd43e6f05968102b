#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace asdfvk {

/// The Euclidean minimum spanning tree of points: pairs of their indices, one pair less than points. Borůvka's
/// algorithm, with nearest points of other groups from a k-d tree whose nodes know when all of their points are of one
/// group (March, Ram and Gray 2010: Fast Euclidean Minimum Spanning Tree). Precondition: the points are finite.
[[nodiscard]] std::vector<std::array<uint32_t, 2>> minimumSpanningTree(std::span<const Vec3d> points);

}  // namespace asdfvk
