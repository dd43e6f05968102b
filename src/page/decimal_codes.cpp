#include "page/decimal_codes.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr int32_t kLowestDigits = 1000, kDigitsPerDecade = 9000;
static_assert(kPageDigits == 4);

// The range of float32, in which a page has its values.
constexpr int kMinExponent = -60, kMaxExponent = 60;

struct Decimal {
  int32_t digits = 0;  ///< With the sign; 0: no decimal.
  int exponent = 0;    ///< value = digits 10^exponent
};

/// 10^e for kMinExponent <= e <= kMaxExponent.
double powerOfTen(int e) {
  static const std::array<double, kMaxExponent - kMinExponent + 1> powers = [] {
    std::array<double, kMaxExponent - kMinExponent + 1> table{};
    for (int i = kMinExponent; i <= kMaxExponent; ++i)
      table[static_cast<size_t>(i - kMinExponent)] = std::pow(10.0, static_cast<double>(i));
    return table;
  }();
  return powers[static_cast<size_t>(e - kMinExponent)];
}

Decimal decimalOf(double value) {
  constexpr double kGreatest = 3.402e38;  // Rounded to four digits, the greatest float32 would be infinite.
  const double size = std::min(std::abs(value), kGreatest);
  int exponent = static_cast<int>(std::floor(std::log10(size))) - (kPageDigits - 1);
  auto digits = static_cast<int32_t>(std::lround(size * powerOfTen(-exponent)));
  if (digits < kLowestDigits) {  // log10 of a number just below a power of ten may be that of the power.
    --exponent;
    digits = static_cast<int32_t>(std::lround(size * powerOfTen(-exponent)));
  }
  if (digits >= kLowestDigits + kDigitsPerDecade) {
    digits = kLowestDigits;
    ++exponent;
  }
  return {value < 0 ? -digits : digits, exponent};
}

}  // namespace

DecimalCodes decimalCodesOf(std::span<const double> values) {
  DecimalCodes result;
  result.codes.resize(values.size());
  result.isMissing.assign(values.size(), 0);
  result.isZero.assign(values.size(), 0);
  std::vector<int8_t> exponents(values.size());
  forEachInParallel(values.size(), [&](uint32_t i) {
    result.isMissing[i] = std::isfinite(values[i]) ? 0 : 1;
    result.isZero[i] = static_cast<float>(values[i]) == 0 ? 1 : 0;
    if (result.isMissing[i] != 0 || result.isZero[i] != 0) return;
    const Decimal decimal = decimalOf(values[i]);
    result.codes[i] = decimal.digits;
    exponents[i] = static_cast<int8_t>(decimal.exponent);
  });
  int lowest = kMaxExponent;
  for (size_t i = 0; i < values.size(); ++i) {
    result.hasMissing = result.hasMissing || result.isMissing[i] != 0;
    result.hasZero = result.hasZero || result.isZero[i] != 0;
    if (result.codes[i] != 0) lowest = std::min<int>(lowest, exponents[i]);
  }
  result.lowestExponent = lowest == kMaxExponent ? 0 : lowest;
  forEachInParallel(values.size(), [&](uint32_t i) {
    int32_t& code = result.codes[i];
    if (code == 0) return;
    const int32_t shift = (exponents[i] - result.lowestExponent) * kDigitsPerDecade - (kLowestDigits - 1);
    code = code > 0 ? code + shift : code - shift;
  });
  return result;
}

}  // namespace asdfvk
