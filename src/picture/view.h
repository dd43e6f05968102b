#pragma once

namespace asdfvk {

enum class UpAxis { X, Y, Z };

/// Where a mesh is looked at from. Azimuth and elevation 0 look at its broad side: along the shorter one of the two
/// axes of its box that are not `up`. A file does not tell what is up, nor which side is the front.
struct View {
  UpAxis up = UpAxis::Y;
  double azimuthDegrees = 30;    ///< How far the viewer has gone to the right around the up axis.
  double elevationDegrees = 18;  ///< How far he then has gone up; -90 to 90.
};

}  // namespace asdfvk
