#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace asdfvk {

/// Eight floats computed side by side (vector extensions of GCC and Clang), each rounded as a float is, whatever the
/// machine's width; functions compiled for wider instructions (core/instruction_set.h) need fewer of them.
inline constexpr size_t kOctetSize = 8;
using Octet = float __attribute__((vector_size(kOctetSize * sizeof(float))));
/// As a mask all bits of an entry are set or none; masks combine by &, and `mask ? a : b` chooses entry by entry.
using OctetIntegers = int32_t __attribute__((vector_size(kOctetSize * sizeof(int32_t))));

}  // namespace asdfvk
