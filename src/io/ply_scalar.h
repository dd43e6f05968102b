#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "io/ply_header.h"

namespace asdfvk {

/// The number of type T at `at`, which need not be aligned, in the file's byte order.
template <typename T, bool isSwapped>
[[nodiscard]] T loadPlyScalar(const char* at) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (isSwapped)
    for (size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  return std::bit_cast<T>(bytes);
}

/// The number of the given type as an Out, which is double or int64_t. Every integer type fits into either.
template <typename Out, bool isSwapped>
[[nodiscard]] Out loadPly(const char* at, PlyType type) {
  switch (type) {
    case PlyType::Int8:
      return static_cast<Out>(loadPlyScalar<int8_t, isSwapped>(at));
    case PlyType::UInt8:
      return static_cast<Out>(loadPlyScalar<uint8_t, isSwapped>(at));
    case PlyType::Int16:
      return static_cast<Out>(loadPlyScalar<int16_t, isSwapped>(at));
    case PlyType::UInt16:
      return static_cast<Out>(loadPlyScalar<uint16_t, isSwapped>(at));
    case PlyType::Int32:
      return static_cast<Out>(loadPlyScalar<int32_t, isSwapped>(at));
    case PlyType::UInt32:
      return static_cast<Out>(loadPlyScalar<uint32_t, isSwapped>(at));
    case PlyType::Float32:
      return static_cast<Out>(loadPlyScalar<float, isSwapped>(at));
    case PlyType::Float64:
      return static_cast<Out>(loadPlyScalar<double, isSwapped>(at));
  }
  return Out{};
}

}  // namespace asdfvk
