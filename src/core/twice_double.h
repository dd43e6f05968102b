#pragma once

#include <cmath>

namespace asdfvk {

/// A number as an unevaluated sum with about 106 bits; `low` is at most half a unit in the last place of `high`.
/// Source: T. J. Dekker 1971, A Floating-Point Technique for Extending the Available Precision. Without fused
/// multiply-add, so that the bits are the same on all machines. Sizes must be between 2^-900 and 2^900.
struct TwiceDouble {
  double high = 0, low = 0;

  constexpr TwiceDouble(double number) : high(number) {}  // NOLINT: implicit by design
  constexpr TwiceDouble(double theHigh, double theLow) : high(theHigh), low(theLow) {}

  [[nodiscard]] constexpr double rounded() const { return high + low; }
};

/// Precondition: a is 0 or not smaller than b.
[[nodiscard]] constexpr TwiceDouble normalized(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

[[nodiscard]] constexpr TwiceDouble exactSum(double a, double b) {
  const double sum = a + b, ofB = sum - a;
  return {sum, (a - (sum - ofB)) + (b - ofB)};
}

[[nodiscard]] constexpr TwiceDouble exactProduct(double a, double b) {
  constexpr double kSplitter = 0x1p27 + 1;
  const double product = a * b;
  const double aLarge = kSplitter * a, bLarge = kSplitter * b;
  const double aHigh = aLarge - (aLarge - a), bHigh = bLarge - (bLarge - b);
  const double aLow = a - aHigh, bLow = b - bHigh;
  return {product, ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow};
}

constexpr TwiceDouble operator-(const TwiceDouble& a) { return {-a.high, -a.low}; }
constexpr TwiceDouble operator+(const TwiceDouble& a, const TwiceDouble& b) {
  const TwiceDouble sum = exactSum(a.high, b.high);
  return normalized(sum.high, sum.low + (a.low + b.low));
}
constexpr TwiceDouble operator-(const TwiceDouble& a, const TwiceDouble& b) { return a + -b; }
constexpr TwiceDouble operator*(const TwiceDouble& a, const TwiceDouble& b) {
  const TwiceDouble product = exactProduct(a.high, b.high);
  return normalized(product.high, product.low + (a.high * b.low + a.low * b.high));
}
constexpr TwiceDouble operator/(const TwiceDouble& a, const TwiceDouble& b) {
  const double quotient = a.high / b.high;
  const TwiceDouble rest = a - b * TwiceDouble(quotient);
  return normalized(quotient, rest.high / b.high);
}

}  // namespace asdfvk
