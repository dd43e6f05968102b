#include "asdf_vk/field.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "core/median.h"
#include "core/parallel.h"

namespace asdfvk {

const Field* findField(std::span<const Field> fields, std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

const Field* findField(std::span<const Field> fields, std::string_view name, FieldLocation location) {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const Field& field) { return field.name == name && field.location == location; });
  return found == fields.end() ? nullptr : &*found;
}

const Field& requireField(std::span<const Field> fields, std::string_view name, FieldLocation location) {
  if (const Field* const field = findField(fields, name, location)) return *field;
  throw Error(ErrorCode::UnknownField, fmt::format("the result has no field {}", name));
}

FieldSummary summarize(const Field& field) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> present;
  present.reserve(field.size());
  for (size_t i = 0; i < field.size(); ++i)
    if (const double value = field.at(i); std::isfinite(value)) present.push_back(value);
  const uint64_t missingCount = field.size() - present.size();
  if (present.empty()) return {kNone, kNone, kNone, missingCount};
  const auto [low, high] = std::minmax_element(present.begin(), present.end());
  FieldSummary summary{*low, kNone, *high, missingCount};
  summary.median = upperMedian(present);
  return summary;
}

void requireSingles(std::span<const double> numbers, std::string_view name) {
  using Limits = std::numeric_limits<float>;
  const auto largestOf = [&](size_t begin, size_t end) {
    double largest = 0;
    for (const double number : numbers.subspan(begin, end - begin))
      if (std::isfinite(number)) largest = std::max(largest, std::abs(number));
    return largest;
  };
  const double largest =
      foldInParallel<double>(numbers.size(), largestOf, [](double a, double b) { return std::max(a, b); });
  if (largest <= Limits::max() && (largest == 0 || largest >= Limits::denorm_min())) return;
  throw Error(ErrorCode::ValueOutOfRange,
              fmt::format("a value of {} in the unit of the mesh does not fit into float32: {:g}; scale the mesh", name,
                          largest));
}

}  // namespace asdfvk
