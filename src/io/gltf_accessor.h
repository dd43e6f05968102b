#pragma once

#include <cstdint>

#include "core/vec3.h"

namespace asdfvk {

/// The types of numbers in accessors.
enum GltfType : uint32_t { kGltfByte = 5120, kGltfUByte, kGltfShort, kGltfUShort, kGltfUInt = 5125, kGltfFloat };

/// The size in bytes.
[[nodiscard]] uint32_t gltfSizeOf(uint32_t componentType);

/// Numbers in a buffer, one or three per element. GltfFile opens accessors and checks their bounds.
class GltfAccessor {
 public:
  /// Elements of a buffer. stride: distance of two elements in bytes.
  struct Elements {
    const char* data = nullptr;  ///< Null: all elements are 0.
    uint64_t stride = 0;
    uint32_t componentType = 0;

    /// Precondition: the type is unsigned.
    [[nodiscard]] uint32_t wholeAt(uint64_t i) const;
  };

  GltfAccessor(uint64_t count, const Elements& elements, bool isNormalized)
      : count_(count), base_(elements), isNormalized_(isNormalized) {}

  [[nodiscard]] uint64_t count() const { return count_; }
  [[nodiscard]] uint32_t componentType() const { return base_.componentType; }
  [[nodiscard]] bool isNormalized() const { return isNormalized_; }
  /// Preconditions: i < count(). vectorAt() needs elements of three numbers; indexAt() needs single unsigned integers.
  [[nodiscard]] Vec3d vectorAt(uint64_t i) const;
  [[nodiscard]] uint32_t indexAt(uint64_t i) const;

  /// Replaces the elements at `indices`, which ascend, by `values`.
  void setSparse(uint64_t count, const Elements& indices, const Elements& values) {
    sparseCount_ = count;
    sparseIndices_ = indices;
    sparseValues_ = values;
  }

 private:
  [[nodiscard]] const char* elementAt(uint64_t i) const;

  uint64_t count_ = 0;
  Elements base_, sparseIndices_, sparseValues_;
  uint64_t sparseCount_ = 0;
  bool isNormalized_ = false;
};

}  // namespace asdfvk
