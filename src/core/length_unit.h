#pragma once

#include <array>
#include <string>
#include <string_view>

#include "asdf_vk/options.h"

namespace asdfvk {

struct LengthUnitRow {
  LengthUnit unit;
  std::string_view name;  ///< A value of Mesh::unit, for example "mm".
  double micrometres;     ///< Length of the unit. A whole number, so that a conversion rounds once.
};
inline constexpr std::array<LengthUnitRow, 6> kLengthUnits{{{LengthUnit::Micrometre, "um", 1},
                                                            {LengthUnit::Millimetre, "mm", 1e3},
                                                            {LengthUnit::Centimetre, "cm", 1e4},
                                                            {LengthUnit::Metre, "m", 1e6},
                                                            {LengthUnit::Inch, "in", 25400},
                                                            {LengthUnit::Foot, "ft", 304800}}};

/// Returns null for an unknown name.
[[nodiscard]] constexpr const LengthUnitRow* findLengthUnit(std::string_view name) {
  for (const LengthUnitRow& row : kLengthUnits)
    if (row.name == name) return &row;
  return nullptr;
}
/// Returns null for LengthUnit::OfMesh.
[[nodiscard]] constexpr const LengthUnitRow* findLengthUnit(LengthUnit unit) {
  for (const LengthUnitRow& row : kLengthUnits)
    if (row.unit == unit) return &row;
  return nullptr;
}

/// The unit of two meshes that state these units (Mesh::unit). A mesh without a unit may be in millimetres. Throws
/// Error{UnitsDiffer} with the names of the meshes.
[[nodiscard]] std::string commonUnit(const std::string& unit, const std::string& other,
                                     const std::string& name = "one mesh", const std::string& otherName = "another");

}  // namespace asdfvk
