// The GLSL types that structs shared by host and device are written in, for C++.
#pragma once

#include <cstdint>

namespace asdfvk::glsl {

using uint = uint32_t;

/// 12 bytes; always followed by a 4-byte scalar, so that std430 agrees.
struct vec3 {
  float x, y, z;
  constexpr bool operator==(const vec3&) const = default;
};

}  // namespace asdfvk::glsl
