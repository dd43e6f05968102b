#pragma once

#include <optional>

namespace asdfvk {

enum class Up { X, Y, Z, MinusX, MinusY, MinusZ };

/// Where a mesh is looked at from. Azimuth and elevation 0 look at its broad side: along the shorter one of the two
/// axes of its box that lie level.
struct View {
  std::optional<Up> up;          ///< Unset: guessUp(), as no file tells.
  double azimuthDegrees = 30;    ///< How far the viewer has gone to the right around the up direction.
  double elevationDegrees = 18;  ///< How far he then has gone up; -90 to 90.
};

}  // namespace asdfvk
