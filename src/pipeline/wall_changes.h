#pragma once

#include <span>

#include "pipeline/comparison_points.h"

namespace asdfvk {

/// Sets FaceThickness::wallChanges and changedPlaces of both versions. ofFaces: #F, the counterpart of the
/// barycentre of each face of `now`.
///
/// A point became worse if it has no counterpart, or if it is thinner than its counterpart (isThinner()). A wall is new
/// if no point of it is at the same place as a thin point of the former version. It became thinner if it has a disc of
/// points that became worse around one that was thin before, and is new, too, if it has one around another point. The
/// disc is as large as that of the definition of walls: its diameter is 7/8 of the thickness. Smaller changes are
/// often those of the triangulation. Throws Error{Cancelled}.
void setWallChanges(const MeasuredVersion& now, const MeasuredVersion& former, std::span<const Counterpart> ofFaces,
                    const RunControl& control);

}  // namespace asdfvk
