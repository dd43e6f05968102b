#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "asdf_vk/field.h"
#include "io/result_view.h"

// Fields in formats without vectors or without NaN.
namespace asdfvk {

/// A column for one component of a field, in formats without vectors (PLY, CSV).
struct FieldColumn {
  std::string name;  ///< The name of the field, followed by _x, _y or _z if it has three components.
  const Field* field = nullptr;
  uint32_t component = 0;

  template <typename Put>
  void putEntry(uint64_t item, Put put) const {
    std::visit([&](const auto& entries) { put(entries[item * field->componentCount + component]); }, field->values);
  }
};

/// The columns of the fields at `location`, in order, without the field `omitted`. Throws Error{OptionConflict} if two
/// columns have the same name, and for a reserved name.
[[nodiscard]] std::vector<FieldColumn> columnsOf(FieldReferences fields, FieldLocation location, const Field* omitted,
                                                 std::initializer_list<std::string_view> reservedNames);

/// Returns 0 for NaN, for formats that cannot store NaN.
[[nodiscard]] inline float withoutNan(double value) { return value == value ? static_cast<float>(value) : 0.0f; }
[[nodiscard]] inline uint8_t withoutNan(uint8_t value) { return value; }
[[nodiscard]] inline uint32_t withoutNan(uint32_t value) { return value; }

}  // namespace asdfvk
