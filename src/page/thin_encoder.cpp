#include "page/thin_encoder.h"

#include <functional>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/json.h"
#include "io/corner_welder.h"
#include "page/mesh_encoder.h"

namespace asdfvk {

Json encodeThinSurface(const ThinSurface& surface, const Box3d& box, PageArrays& arrays) {
  ASDFVK_CHECK(surface.regions.size() == surface.triangles.size());
  CornerWelder welder(surface.triangles.size());
  Mesh mesh;
  for (const auto& [a, b, c] : surface.triangles)
    mesh.faces.push_back({welder.indexOf(a), welder.indexOf(b), welder.indexOf(c)});
  mesh.vertices = std::move(welder.points());
  const Field region{.name = "region", .label = "region", .values = surface.regions};
  return encodeMesh(mesh, std::vector<std::reference_wrapper<const Field>>{region}, arrays, box);
}

}  // namespace asdfvk
