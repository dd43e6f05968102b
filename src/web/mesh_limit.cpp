#include "web/mesh_limit.h"

#include <fmt/core.h>

#include <string>

#include "asdf_vk/error.h"
#include "core/text.h"

namespace asdfvk {

void requireMemory(const Mesh& mesh) {
  if (mesh.faces.size() <= kMaxPageTriangleCount) return;
  throw Error(
      ErrorCode::InputTooLarge,
      fmt::format("has {}; a page computes meshes of at most {}, because its memory is limited to 4 GB; use the "
                  "program asdf-vk, or a coarser mesh",
                  counted(mesh.faces.size(), "triangle"), counted(kMaxPageTriangleCount, "triangle")),
      {{"limit", std::to_string(kMaxPageTriangleCount)}});
}

}  // namespace asdfvk
