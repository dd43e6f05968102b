#include "page/thin_encoder.h"

#include <bit>
#include <functional>
#include <unordered_map>
#include <vector>

#include "core/check.h"
#include "core/json.h"
#include "page/mesh_encoder.h"

namespace asdfvk {
namespace {

struct PositionHash {
  size_t operator()(const Vec3d& p) const {
    uint64_t hash = 0;
    for (const double x : {p.x, p.y, p.z})
      hash = (hash ^ std::bit_cast<uint64_t>(x)) * 0x9e3779b97f4a7c15ULL + (hash >> 29);
    return hash ^ (hash >> 32);
  }
};

}  // namespace

Json encodeThinSurface(const ThinSurface& surface, const Box3d& box, PageArrays& arrays) {
  ASDFVK_CHECK(surface.regions.size() == surface.triangles.size());
  Mesh mesh;
  std::unordered_map<Vec3d, uint32_t, PositionHash> vertexAt;
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
