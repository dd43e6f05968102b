#pragma once

#include <optional>

namespace asdfvk {

enum class Up { X, Y, Z, MinusX, MinusY, MinusZ };

/// Direction of view. Azimuth and elevation 0 show the broad side of the mesh: the view is along the shorter of the two
/// horizontal axes of its box.
struct View {
  std::optional<Up> up;          ///< Unset: guessUp(), because no format stores it.
  double azimuthDegrees = 30;    ///< Position of the viewer to the right, around the up direction.
  double elevationDegrees = 18;  ///< Position of the viewer above the horizon, -90 to 90.
};

}  // namespace asdfvk
