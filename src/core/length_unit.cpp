#include "core/length_unit.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"

namespace asdfvk {

std::string commonUnit(const std::string& unit, const std::string& other, const std::string& name,
                       const std::string& otherName) {
  constexpr const char* kWithoutUnit = "mm";
  if (unit == other) return unit;
  if (unit.empty() && other == kWithoutUnit) return other;
  if (other.empty() && unit == kWithoutUnit) return unit;
  const auto text = [](const std::string& each) { return each.empty() ? "states no unit" : "has the unit " + each; };
  throw Error(ErrorCode::UnitsDiffer, fmt::format("{} {}, and {} {}; save both in the same unit and format", name,
                                                  text(unit), otherName, text(other)));
}

}  // namespace asdfvk
