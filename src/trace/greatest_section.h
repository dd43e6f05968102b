#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "trace/trace_scene.h"

namespace asdfvk {

inline constexpr double kSectionTolerance = 1e-3;
/// Limits the memory of a search to 0.2 GB.
inline constexpr uint32_t kMaxBoxCount = 200'000;

/// The largest ball inside of a solid, in normalised coordinates.
struct GreatestSection {
  Vec3d centre;
  double diameter = std::numeric_limits<double>::infinity();
  /// Bound of the diameters of all balls inside. The bound is at most (1 + kSectionTolerance) * diameter, or greater if
  /// the search ended early.
  double bound = std::numeric_limits<double>::infinity();

  /// Whether a search can add nothing.
  [[nodiscard]] bool isExact() const {
    return bound < std::numeric_limits<double>::infinity() && bound <= (1 + 1.001 * kSectionTolerance) * diameter;
  }
  [[nodiscard]] bool caps(double thickness) const { return thickness > (1 + kSectionTolerance) * diameter; }
  [[nodiscard]] double capped(double thickness) const { return caps(thickness) ? diameter : thickness; }
};

/// Where a search for a greatest section ends before the tolerance.
struct SectionSearch {
  /// Largest number of boxes that are divided. Several solids share them, but each has kLeastBoxCount.
  uint32_t boxCount = kMaxBoxCount;
  uint32_t boxesPerFace = 0;  ///< Added for each face of the solid.
  /// The search ends as soon as a ball with this diameter is found, or as no ball can have it.
  double enough = std::numeric_limits<double>::infinity();
};
/// A first search, which often finds the greatest section of a simple solid.
inline constexpr SectionSearch kFirstSection{.boxCount = 250};
/// The work is in proportion to the faces, up to kMaxBoxCount.
inline constexpr SectionSearch kQuickSection{.boxCount = 1000, .boxesPerFace = 1};
inline constexpr uint32_t kLeastBoxCount = 32;

/// The greatest section of each wanted solid; infinite for other solids. Branch and bound over boxes in the box of the
/// solid, which begins with the middles of some inward rays. A convex combination of the distances to points, faces and
/// planes of the surface bounds the radii of the balls with centres in a box; the best combination is the solution
/// of a matrix game. Precondition: the faces of a wanted solid are closed and consistently wound. solidOf: #F.
/// isWanted: one entry per solid. Throws Error{Cancelled}.
[[nodiscard]] std::vector<GreatestSection> findGreatestSections(const TraceScene& scene,
                                                                std::span<const uint32_t> solidOf,
                                                                std::span<const uint8_t> isWanted,
                                                                const SectionSearch& search, const RunControl& control);

/// Replaces the sections of wanted solids that are not exact by those of a new search.
void searchInexactSections(const TraceScene& scene, std::span<const uint32_t> solidOf,
                           std::span<const uint8_t> isWanted, const SectionSearch& search, const RunControl& control,
                           std::vector<GreatestSection>& sections);

}  // namespace asdfvk
