#pragma once

#include <cstring>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "asdf_vk/field.h"

// Fields as files hold them: names, columns of single components, numbers.
namespace asdfvk {

/// At least one character; letters of ASCII, digits and '_' only.
[[nodiscard]] bool isFieldName(std::string_view name);

using FieldReferences = std::span<const std::reference_wrapper<const Field>>;

/// One component of a field, for formats without vectors: a property of PLY, a column of CSV.
struct FieldColumn {
  std::string name;  ///< The name of the field; with three components, and _x, _y or _z.
  const Field* field = nullptr;
  uint32_t component = 0;

  /// Calls put with the entry of a face or vertex: double, uint8_t or uint32_t.
  template <typename Put>
  void putEntry(uint64_t item, Put put) const {
    std::visit([&](const auto& entries) { put(entries[item * field->componentCount + component]); }, field->values);
  }
};

/// The columns of the fields of that location, in order, without those of the field `omitted`. Throws
/// Error{OptionConflict} for two columns of one name, and for a reserved name.
[[nodiscard]] std::vector<FieldColumn> columnsOf(FieldReferences fields, FieldLocation location, const Field* omitted,
                                                 std::initializer_list<std::string_view> reservedNames);

/// The inverse: joins three successive fields of one location and type, named NAME_x, NAME_y and NAME_z, to NAME.
[[nodiscard]] std::vector<Field> joinColumns(std::vector<Field> columns);

/// Throws Error{UnreadableInput} for an invalid name and for two equal ones, as in a file.
void requireReadableNames(std::span<const Field> fields);

/// An entry of a field in a format of float32 numbers without NaN: 0 for no value.
[[nodiscard]] inline float withoutNan(double value) { return value == value ? static_cast<float>(value) : 0.0f; }
[[nodiscard]] inline uint8_t withoutNan(uint8_t value) { return value; }
[[nodiscard]] inline uint32_t withoutNan(uint32_t value) { return value; }

/// Numbers of type T, unaligned and in the byte order of the host, as the entries of a field: float as double. Ignores
/// an incomplete number at the end.
template <typename T>
[[nodiscard]] Field::Values storedEntries(std::span<const char> bytes) {
  std::vector<std::conditional_t<std::is_floating_point_v<T>, double, T>> entries(bytes.size() / sizeof(T));
  for (size_t i = 0; i < entries.size(); ++i) {
    T number;
    std::memcpy(&number, bytes.data() + i * sizeof(T), sizeof(T));
    entries[i] = number;
  }
  return entries;
}

}  // namespace asdfvk
