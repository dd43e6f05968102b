#pragma once

#include <cstdint>
#include <span>

#include "asdf_vk/files.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// One entry per input face, in file order. Views only.
struct FaceValues {
  std::span<const double> values;   ///< #I, NaN where there is none.
  std::span<const uint8_t> isSeed;  ///< #I, 1 where rays were cast.
};

}  // namespace asdfvk
