#pragma once

#include <cstdint>
#include <span>

#include "trace/trace_scene.h"

namespace asdfvk {

/// The largest ball inside of a solid, in normalised coordinates.
struct GreatestSection {
  Vec3d centre;
  double diameter = 0;
  double bound = 0;  ///< No ball inside is larger: at most (1 + kSectionTolerance) diameter, unless maxCubeCount ended.
};

inline constexpr double kSectionTolerance = 1e-3;

/// By branch and bound over cubes in the box of the solid. The distance from the surface at the centre of a cube, plus
/// its half diagonal, bounds the radii of all balls whose centres are in the cube; so do two points of opposite walls,
/// as no ball contains them. Precondition: the faces of the solid are closed and consistently wound.
/// solidOf: #F, the solid of each face.
[[nodiscard]] GreatestSection findGreatestSection(const TraceScene& scene, std::span<const uint32_t> solidOf,
                                                  uint32_t solid, uint32_t maxCubeCount = 200'000);

}  // namespace asdfvk
