#pragma once

#include <cstdlib>

#include "pipeline/asdf.h"

namespace asdfvk::test {

/// One session on the best Vulkan device for a whole test program, under the validation layers: compute() throws what
/// they say.
inline Session& vulkanSession() {
  ::setenv("ASDF_VK_VALIDATION", "1", 1);
  static Session session({.backend = Backend::Vulkan});
  return session;
}

inline Session& referenceSession() {
  static Session session({.backend = Backend::Reference});
  return session;
}

}  // namespace asdfvk::test
