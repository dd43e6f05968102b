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

/// One quantity of a result, with one item per input face or vertex, in the order of the input.
struct Field {
  /// Real numbers are double in memory and in CSV, and float32 in the other formats. NaN means no value.
  using Values = std::variant<std::vector<double>, std::vector<uint8_t>, std::vector<uint32_t>>;

  /// Letters, digits and '_'. Unique among the face fields, and among the vertex fields, of a result.
  std::string name;
  std::string label;  ///< Display name: "shape diameter".
  std::string unit;   ///< "length": the unit of the mesh. Empty: no unit, as for flags and indices.
  FieldLocation location = FieldLocation::PerFace;
  uint32_t componentCount = 1;  ///< Entries per item: 1, or 3 for a point.
  Values values;                ///< Item i has the entries i * componentCount .. (i + 1) * componentCount - 1.

  [[nodiscard]] size_t size() const {  ///< Number of entries, over all components.
    return std::visit([](const auto& entries) { return entries.size(); }, values);
  }
  [[nodiscard]] size_t itemCount() const { return componentCount == 0 ? 0 : size() / componentCount; }
  [[nodiscard]] double at(size_t i) const {
    return std::visit([i](const auto& entries) { return static_cast<double>(entries[i]); }, values);
  }
  /// The real numbers of the field; null if the field holds integers.
  [[nodiscard]] const std::vector<double>* reals() const { return std::get_if<std::vector<double>>(&values); }
};

[[nodiscard]] ASDFVK_API const Field* findField(std::span<const Field> fields, std::string_view name);
[[nodiscard]] ASDFVK_API const Field* findField(std::span<const Field> fields, std::string_view name,
                                                FieldLocation location);
/// Like findField(), but throws Error{UnknownField} if the field does not exist.
[[nodiscard]] ASDFVK_API const Field& requireField(std::span<const Field> fields, std::string_view name,
                                                   FieldLocation location = FieldLocation::PerFace);

/// Smallest finite entry, upper median, largest finite entry, and number of entries without a value. If no entry has a
/// value, `min`, `median` and `max` are NaN.
struct FieldSummary {
  double min, median, max;
  uint64_t missingCount;
};
[[nodiscard]] ASDFVK_API FieldSummary summarize(const Field& field);

/// Throws Error{ValueOutOfRange} if a finite number is beyond the range of float32, or if all numbers are so small that
/// they would become 0. name: describes the numbers in the message.
ASDFVK_API void requireSingles(std::span<const double> numbers, std::string_view name);

}  // namespace asdfvk
