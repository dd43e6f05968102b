#pragma once

#include <span>
#include <string_view>

#include "asdf_vk/field.h"
#include "asdf_vk/options.h"

namespace asdfvk {

enum class FieldType { Real, Flag, Label };

struct FieldRow {
  const char* name;
  const char* label;
  const char* unit = "";  ///< See Field::unit.
  FieldType type = FieldType::Real;
  uint32_t componentCount = 1;
  const char* needs = nullptr;  ///< The option that computes the field, in braces; null: none is needed.
  /// Whether the options compute the field; null: always, after request().
  bool (*isComputed)(const Options&) = nullptr;
  /// Sets the options that a user implies who asks for the field; null: none.
  void (*request)(Options&) = nullptr;
  const char* meaning;  ///< Meaning of the entry of a face.
};

/// All fields, in the order of a result.
[[nodiscard]] std::span<const FieldRow> fieldRows();

/// Precondition: fieldRows() has a row with the name.
[[nodiscard]] const FieldRow& fieldRow(std::string_view name);

/// Preconditions: fieldRows() has a row with the name, and `values` has the type of the row.
[[nodiscard]] Field makeField(std::string_view name, Field::Values values);

}  // namespace asdfvk
