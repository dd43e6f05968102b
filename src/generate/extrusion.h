#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

/// Solids from outlines.
namespace asdfvk::solids {

/// A point (x, y).
using OutlinePoint = std::pair<double, double>;
using Outline = std::vector<OutlinePoint>;

/// The prism from z = 0 to `height` over a simple polygon, in either direction. The coarsest triangulation.
Mesh extruded(Outline outline, double height);
/// Points on an arc around (x, y), from one angle to another one, both included.
Outline arc(double x, double y, double radius, double fromDegrees, double toDegrees, uint32_t sideCount);
/// Halves the longest edges until none is longer than `longestEdge`. The surface stays the same.
Mesh refined(Mesh mesh, double longestEdge);
/// Rotated around z, then around x.
Mesh turned(Mesh mesh, double yaw, double pitch);

}  // namespace asdfvk::solids
