#include "pipeline/skeleton_points.h"

#include <cmath>

#include "asdf_vk/field.h"

namespace asdfvk {
namespace {

/// A mean normal that is shorter has no direction: the triangles of the polygon face each other.
constexpr double kNoNormal = 1e-9;

}  // namespace

std::vector<double> centresOfInputFaces(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                        std::span<const double> sdf) {
  std::vector<Vec3d> places(sdf.size()), normals(sdf.size());
  std::vector<double> areas(sdf.size(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    if (geometry.isDegenerate(face)) continue;
    const uint32_t inputFace = mesh.inputFaceOf(face);
    areas[inputFace] += geometry.areas[face];
    const double share = geometry.areas[face] / areas[inputFace];  // Means by increments: they cannot overflow.
    places[inputFace] += (geometry.barycentres[face] - places[inputFace]) * share;
    normals[inputFace] += (geometry.normals[face] - normals[inputFace]) * share;
  }
  std::vector<double> centres(3 * sdf.size(), kNoValue);
  for (size_t i = 0; i < sdf.size(); ++i) {
    const double norm = length(normals[i]);
    if (std::isnan(sdf[i]) || !(norm > kNoNormal)) continue;
    const Vec3d centre = places[i] - normals[i] * (sdf[i] / 2 / norm);
    for (size_t axis = 0; axis < 3; ++axis) centres[3 * i + axis] = centre[axis];
  }
  return centres;
}

}  // namespace asdfvk
