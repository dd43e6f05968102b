#include "core/length_unit.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"

namespace asdfvk {

std::string commonUnit(const std::string& unit, const std::string& other) {
  constexpr const char* kWithoutUnit = "mm";
  if (unit == other) return unit;
  if (unit.empty() && other == kWithoutUnit) return other;
  if (other.empty() && unit == kWithoutUnit) return unit;
  const auto text = [](const std::string& each) { return each.empty() ? "states no unit" : "is in " + each; };
  throw Error(ErrorCode::UnitsDiffer, fmt::format("one mesh {}, and another {}; save both in the same unit and format",
                                                  text(unit), text(other)));
}

}  // namespace asdfvk
