#pragma once

#include <cstdint>

namespace asdfvk {

/// Four floats side by side: x, y, z and one of no axis, or any four. Vectors of this length are native to every
/// machine, longer ones (core/octet.h) are taken apart where they are not.
using Quad = float __attribute__((vector_size(16)));
using QuadIntegers = int32_t __attribute__((vector_size(16)));

[[nodiscard]] inline Quad leastOf(const Quad& a, const Quad& b) { return a < b ? a : b; }
[[nodiscard]] inline Quad greatestOf(const Quad& a, const Quad& b) { return a > b ? a : b; }

}  // namespace asdfvk
