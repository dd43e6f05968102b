#include "mesh/mesh.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"

namespace asdfvk {

void requireAtMost(uint64_t limit, uint64_t count, const char* plural) {
  if (count > limit)
    throw Error(ErrorCode::MeshTooLarge,
                fmt::format("the mesh has {} {}; at most {} are supported", count, plural, limit));
}

}  // namespace asdfvk
