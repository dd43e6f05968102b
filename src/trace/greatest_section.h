#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "trace/trace_scene.h"

namespace asdfvk {

inline constexpr double kSectionTolerance = 1e-3;

/// The largest ball inside of a solid, in normalised coordinates.
struct GreatestSection {
  Vec3d centre;
  double diameter = std::numeric_limits<double>::infinity();
  /// Bound of the diameters of all balls inside. The bound is at most (1 + kSectionTolerance) * diameter, or greater if
  /// the search ended early.
  double bound = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool caps(double thickness) const { return thickness > (1 + kSectionTolerance) * diameter; }
  [[nodiscard]] double capped(double thickness) const { return caps(thickness) ? diameter : thickness; }
};

/// Where a search for a greatest section ends before the tolerance.
struct SectionSearch {
  /// Largest number of cubes that are divided. Several solids share them, but each has kLeastCubeCount.
  uint32_t cubeCount = 200'000;
  uint32_t cubesPerFace = 0;  ///< Added for each face of the solid.
  /// The search ends as soon as a ball with this diameter is found, or as no ball can have it.
  double enough = std::numeric_limits<double>::infinity();
};
/// A first search, which often finds the greatest section of a simple solid.
inline constexpr SectionSearch kFirstSection{.cubeCount = 250};
/// The work is in proportion to the faces.
inline constexpr SectionSearch kQuickSection{.cubeCount = 1000, .cubesPerFace = 1};
inline constexpr uint32_t kLeastCubeCount = 32;

/// The greatest section of each wanted solid; infinite for other solids. Branch and bound over cubes in the box of the
/// solid, which begins with the middles of some inward rays. Three bounds limit the radii of the balls with centres in
/// a cube. The first is the distance from the centre of the cube to the surface, plus half of the diagonal of the cube.
/// The second is a bound by two points of opposite walls, which no ball contains. The third is a bound by the planes of
/// flat walls. Precondition: the faces of a wanted solid are closed and consistently wound. solidOf: #F. isWanted: one
/// entry per solid. Throws Error{Cancelled}.
[[nodiscard]] std::vector<GreatestSection> findGreatestSections(const TraceScene& scene,
                                                                std::span<const uint32_t> solidOf,
                                                                std::span<const uint8_t> isWanted,
                                                                const SectionSearch& search, const RunControl& control);

}  // namespace asdfvk
