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
  /// No ball inside is larger: at most (1 + kSectionTolerance) diameter, unless the search was too long.
  double bound = std::numeric_limits<double>::infinity();
};

inline constexpr double kSectionTolerance = 1e-3;

/// The greatest section of each wanted solid; infinite for the others. By branch and bound over cubes in the box of the
/// solid. The distance from the surface at the centre of a cube, plus its half diagonal, bounds the radii of all balls
/// whose centres are in the cube; so do two points of opposite walls, as no ball contains them, and the planes of flat
/// walls. Precondition: the faces of a wanted solid are closed and consistently wound. solidOf: #F, the solid of each
/// face. Throws Error{Cancelled}.
[[nodiscard]] std::vector<GreatestSection> findGreatestSections(const TraceScene& scene,
                                                                std::span<const uint32_t> solidOf,
                                                                std::span<const uint8_t> isWanted,
                                                                const RunControl& control);

}  // namespace asdfvk
