#include "page/thin_encoder.h"

#include <functional>
#include <unordered_map>
#include <vector>

#include "core/check.h"
#include "core/json.h"
#include "mesh/coincident_faces.h"
#include "page/mesh_encoder.h"

namespace asdfvk {
Json encodeThinSurface(const ThinSurface& surface, const Box3d& box, PageArrays& arrays) {
  ASDFVK_CHECK(surface.regions.size() == surface.triangles.size());
  Mesh mesh;
  const auto hash = [](const Vec3d& p) { return hashOf(p); };
  std::unordered_map<Vec3d, uint32_t, decltype(hash)> vertexAt;
  mesh.faces.reserve(surface.triangles.size());
  for (const auto& corners : surface.triangles) {
    Face face{};
    for (size_t k = 0; k < 3; ++k) {
      const auto [found, isNew] = vertexAt.try_emplace(corners[k], static_cast<uint32_t>(mesh.vertices.size()));
      if (isNew) mesh.vertices.push_back(corners[k]);
      face[k] = found->second;
    }
    mesh.faces.push_back(face);
  }
  const Field region{.name = "region", .label = "region", .values = surface.regions};
  return encodeMesh(mesh, std::vector<std::reference_wrapper<const Field>>{region}, arrays, box);
}

}  // namespace asdfvk
