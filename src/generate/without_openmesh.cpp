#include "asdf_vk/error.h"
#include "generate/analytic_shapes.h"

namespace asdfvk {

GeneratedShape makeIcosphere(uint64_t) {
  throw Error(ErrorCode::UnknownName,
              "the shape icosphere needs OpenMesh, and this build has none; use the shape sphere");
}

}  // namespace asdfvk
