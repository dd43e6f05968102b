#pragma once

#include <span>
#include <string_view>

#include "asdf_vk/field.h"

namespace asdfvk {

enum class FieldType { Real, Flag, Label };

/// A field that a result may have.
struct FieldRow {
  const char* name;
  const char* label;
  const char* unit = "";  ///< See Field::unit.
  FieldType type = FieldType::Real;
  uint32_t componentCount = 1;
  const char* needs = nullptr;  ///< The option that computes the field; null: none.
  const char* meaning;          ///< The meaning of an entry per face.
};

/// All fields, in the order in which a result has them.
[[nodiscard]] std::span<const FieldRow> fieldRows();

/// The field of that name with the entries. Precondition: fieldRows() has the name, and its type is that of `values`.
[[nodiscard]] Field makeField(std::string_view name, Field::Values values);

}  // namespace asdfvk
