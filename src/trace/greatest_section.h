#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// The largest ball inside of a solid, in normalised coordinates.
struct GreatestSection {
  Vec3d centre;
  double diameter = std::numeric_limits<double>::infinity();
  /// Bound of the diameters of all balls inside. The bound is at most (1 + kSectionTolerance) * diameter, or greater if
  /// the search reached its limit.
  double bound = std::numeric_limits<double>::infinity();
};

inline constexpr double kSectionTolerance = 1e-3;

/// The greatest section of each wanted solid; infinite for other solids. Branch and bound over cubes in the box of the
/// solid. Three bounds limit the radii of the balls with centres in a cube. The first is the distance from the centre
/// of the cube to the surface, plus half of the diagonal of the cube. The second is a bound by two points of opposite
/// walls, which no ball contains. The third is a bound by the planes of flat walls. Precondition: the faces of a wanted
/// solid are closed and consistently wound. solidOf: #F. isWanted: one entry per solid. Throws Error{Cancelled}.
[[nodiscard]] std::vector<GreatestSection> findGreatestSections(const TraceScene& scene,
                                                                std::span<const uint32_t> solidOf,
                                                                std::span<const uint8_t> isWanted,
                                                                const RunControl& control);

}  // namespace asdfvk
