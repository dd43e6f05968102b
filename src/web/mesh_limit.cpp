#include "web/mesh_limit.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"
#include "core/text.h"

namespace asdfvk {

void requireMemory(const Mesh& mesh, const std::string& name) {
  if (mesh.faces.size() <= kMaxPageTriangleCount) return;
  throw Error(ErrorCode::InputTooLarge, fmt::format("{}: has {}", name, counted(mesh.faces.size(), "triangle")),
              {{"limit", std::to_string(kMaxPageTriangleCount)}});
}

std::string memoryRemedy() {
  return fmt::format("this page computes at most {}; use the program asdf-vk, or a coarser mesh",
                     counted(kMaxPageTriangleCount, "triangle"));
}

}  // namespace asdfvk
