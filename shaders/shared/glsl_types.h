// C++ equivalents of the GLSL types in structs shared by host and device. Sizes are asserted: there is no padding.
#pragma once

#include <cstdint>

namespace asdfvk::glsl {

using uint = uint32_t;

/// 12 bytes. Must be followed by a 4-byte scalar: std430 aligns a vec3 to 16 bytes.
struct vec3 {
  float x, y, z;
  constexpr bool operator==(const vec3&) const = default;
};

/// 16 bytes, at offsets that are multiples of 16.
struct uvec4 {
  uint words[4];
  constexpr bool operator==(const uvec4&) const = default;
};

}  // namespace asdfvk::glsl
