#include "mesh/face_domain.h"

namespace asdfvk {

FaceGeometry geometryOf(const FaceGeometry& geometry, std::span<const uint32_t> faces) {
  return {entriesAt<UnsetVector<Vec3d>>(faces, geometry.barycentres),
          entriesAt<UnsetVector<Vec3d>>(faces, geometry.normals), entriesAt<UnsetVector<double>>(faces, geometry.areas),
          geometry.bounds};
}

}  // namespace asdfvk
