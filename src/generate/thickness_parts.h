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
  /// Minimum outside of sharp regions; infinite if the whole surface is sharp. A sharp region is connected to a sharp
  /// edge or tip, and thinner than this minimum.
  double leastWall = std::numeric_limits<double>::infinity();
  double sharpAngleDegrees = 0;  ///< Inner angle of the sharp edges or of the tip; 0 without a sharp edge or tip.
  double sharpLength = 0;        ///< Sum of the lengths of all sharp edges.
};

/// Names of the parts: wedges, plates with ribs, pockets, cups, brackets with fillets, ligaments beside holes, threads.
[[nodiscard]] std::vector<std::string_view> thicknessPartNames();

/// Throws Error{OptionOutOfRange} for an unknown name.
[[nodiscard]] ThicknessPart makeThicknessPart(std::string_view name);

}  // namespace asdfvk
