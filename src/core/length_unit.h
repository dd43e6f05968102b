#pragma once

#include <array>
#include <string_view>

namespace asdfvk {

/// A unit of length.
struct LengthUnit {
  std::string_view name;  ///< As in Mesh::unit.
  double micrometres;     ///< A whole number, so that a conversion rounds once.
};
inline constexpr std::array<LengthUnit, 6> kLengthUnits{
    {{"um", 1}, {"mm", 1e3}, {"cm", 1e4}, {"m", 1e6}, {"in", 25400}, {"ft", 304800}}};

/// Null for an unknown name.
[[nodiscard]] constexpr const LengthUnit* findLengthUnit(std::string_view name) {
  for (const LengthUnit& unit : kLengthUnits)
    if (unit.name == name) return &unit;
  return nullptr;
}

}  // namespace asdfvk
