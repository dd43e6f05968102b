#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "generate/block_solid.h"

namespace asdfvk {

/// A part whose least wall thickness (docs/thickness.md) is known by construction, at any triangulation. Lengths in mm.
struct ThicknessPart {
  BlockSolid solid;
  double leastThickness = 0;  ///< Minimum over all points of the surface; 0 with a sharp edge or tip.
  /// Minimum without sharp regions, which are connected with a sharp edge or tip and below this thickness. Infinite
  /// where the whole surface is a sharp region.
  double leastWall = std::numeric_limits<double>::infinity();
  double sharpAngleDegrees = 0;  ///< Inner angle of its sharp edges, or of its tip; 0 without one.
  double sharpLength = 0;        ///< Sum over all its sharp edges.
};

/// Wedges, plates with ribs, pockets, cups, brackets with fillets, ligaments beside holes, threads.
[[nodiscard]] std::vector<std::string_view> thicknessPartNames();

/// Throws Error{OptionOutOfRange} for an unknown name.
[[nodiscard]] ThicknessPart makeThicknessPart(std::string_view name);

}  // namespace asdfvk
