#include "io/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace asdfvk {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is read by copying its bytes");

template <typename T>
T gltfNumber(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

}  // namespace

uint32_t gltfSizeOf(uint32_t componentType) {
  switch (componentType) {
    case kGltfByte:
    case kGltfUByte:
      return 1;
    case kGltfShort:
    case kGltfUShort:
      return 2;
    default:
      return 4;
  }
}

uint32_t GltfAccessor::Elements::wholeAt(uint64_t i) const {
  const char* const from = data + i * stride;
  switch (componentType) {
    case kGltfUByte:
      return gltfNumber<uint8_t>(from);
    case kGltfUShort:
      return gltfNumber<uint16_t>(from);
    default:
      return gltfNumber<uint32_t>(from);
  }
}

const char* GltfAccessor::elementAt(uint64_t i) const {
  uint64_t low = 0, high = sparseCount_;  // Bounds of the position of the first sparse index that is not below i.
  while (low < high) {
    const uint64_t middle = (low + high) / 2;
    sparseIndices_.wholeAt(middle) < i ? low = middle + 1 : high = middle;
  }
  if (low < sparseCount_ && sparseIndices_.wholeAt(low) == i) return sparseValues_.data + low * sparseValues_.stride;
  constexpr static std::array<char, 12> kZeros{};
  return base_.data == nullptr ? kZeros.data() : base_.data + i * base_.stride;
}

Vec3d GltfAccessor::vectorAt(uint64_t i) const {
  const char* const from = elementAt(i);
  Vec3d vector;
  const auto fill = [&]<typename T>(T) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto number = static_cast<double>(gltfNumber<T>(from + axis * sizeof(T)));
      vector[axis] =
          isNormalized_ ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : number;
    }
  };
  switch (base_.componentType) {
    case kGltfByte:
      fill(int8_t{});
      break;
    case kGltfUByte:
      fill(uint8_t{});
      break;
    case kGltfShort:
      fill(int16_t{});
      break;
    case kGltfUShort:
      fill(uint16_t{});
      break;
    default:
      fill(float{});
  }
  return vector;
}

uint32_t GltfAccessor::indexAt(uint64_t i) const { return Elements{elementAt(i), 0, base_.componentType}.wholeAt(0); }

}  // namespace asdfvk
