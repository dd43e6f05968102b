#include "mesh/point_fans.h"

#include "mesh/coincident_faces.h"

namespace asdfvk {

PointFans::PointFans(const TriangleMesh& mesh)
    : pointOf_(coincidentVertices(mesh.vertices)),
      corners_(sortIntoBuckets<uint32_t>(mesh.vertices.size(), mesh.faceCount(), [&](uint32_t face, auto&& put) {
        for (uint32_t k = 0; k < 3; ++k) put(pointOf_[mesh.faces[face][k]], 3 * face + k);
      })) {}

}  // namespace asdfvk
