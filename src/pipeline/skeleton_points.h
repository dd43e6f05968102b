#pragma once

#include <span>
#include <vector>

#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Skeleton points of input faces: c - n sdf / 2, the middle of the shape below the face. c and n are the barycentre
/// and the normal of a triangle. For a polygon they are the means over its triangles, weighted by area; n is then
/// scaled to length 1. sdf: #I. Returns 3 #I: x, y, z; NaN where there is no value or no normal (all triangles of zero
/// area).
[[nodiscard]] std::vector<double> centresOfInputFaces(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                                      std::span<const double> sdf);

}  // namespace asdfvk
