#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// Decimal digits of a value in a page: what the page shows is what the result has, rounded to these.
inline constexpr int kPageDigits = 4;

/// Values rounded to kPageDigits digits as whole numbers that ascend with the value: sign (9000 decade + digits - 999),
/// where the digits are 1000 to 9999 and the decade counts from the lowest one. Entries that are not finite or are 0 in
/// float32 have no code; they have a mark instead.
struct DecimalCodes {
  std::vector<int32_t> codes;  ///< 0 where a mark is set.
  std::vector<uint8_t> isMissing, isZero;
  int lowestExponent = 0;  ///< value = sign digits 10^(lowestExponent + decade).
  bool hasMissing = false, hasZero = false;
};

[[nodiscard]] DecimalCodes decimalCodesOf(std::span<const double> values);

/// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
[[nodiscard]] constexpr uint32_t zigzag(int32_t number) {
  return static_cast<uint32_t>(number) << 1 ^ static_cast<uint32_t>(number >> 31);
}

}  // namespace asdfvk
