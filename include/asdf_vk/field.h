#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "asdf_vk/api.h"

namespace asdfvk {

enum class FieldLocation { PerFace, PerVertex };

/// One quantity of a result: per input face or per vertex of the input, in file order. Every writer, the JSON report
/// and the picture accept any list of fields.
struct Field {
  /// Real numbers are double in memory and in CSV, float32 in the binary formats; NaN = no value.
  using Values = std::variant<std::vector<double>, std::vector<uint8_t>, std::vector<uint32_t>>;

  std::string name;   ///< Letters, digits, '_'; unique among the fields of a result with the same location.
  std::string label;  ///< Display name: "shape diameter".
  std::string unit;   ///< "length" (the unit of the mesh), or empty for numbers without a unit, flags and indices.
  FieldLocation location = FieldLocation::PerFace;
  uint32_t componentCount = 1;  ///< 3 for a point.
  Values values;                ///< Item i has the entries i componentCount .. (i + 1) componentCount - 1.

  [[nodiscard]] size_t size() const {  ///< Entries, all components counted.
    return std::visit([](const auto& entries) { return entries.size(); }, values);
  }
  [[nodiscard]] size_t itemCount() const { return componentCount == 0 ? 0 : size() / componentCount; }
  /// Entry i as a number.
  [[nodiscard]] double at(size_t i) const {
    return std::visit([i](const auto& entries) { return static_cast<double>(entries[i]); }, values);
  }
  /// Null where the field holds integers.
  [[nodiscard]] const std::vector<double>* reals() const { return std::get_if<std::vector<double>>(&values); }
};

/// The first field of that name, or null.
[[nodiscard]] ASDFVK_API const Field* findField(std::span<const Field> fields, std::string_view name);
/// The field of that name and location, or null.
[[nodiscard]] ASDFVK_API const Field* findField(std::span<const Field> fields, std::string_view name,
                                                FieldLocation location);
/// Throws Error{UnknownField} where there is none.
[[nodiscard]] ASDFVK_API const Field& requireField(std::span<const Field> fields, std::string_view name,
                                                   FieldLocation location = FieldLocation::PerFace);

/// Smallest and largest finite entry, the upper median, and the number of entries without a value. Without any value
/// the three numbers are NaN.
struct FieldSummary {
  double min, median, max;
  uint64_t missingCount;
};
[[nodiscard]] ASDFVK_API FieldSummary summarize(const Field& field);

/// Throws Error{ValueOutOfRange} for a finite number beyond the range of float32, and where the numbers are so small
/// that all of them would be 0. name: of the numbers, for the message.
ASDFVK_API void requireSingles(std::span<const double> numbers, std::string_view name);

}  // namespace asdfvk
