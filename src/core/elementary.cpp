#include "core/elementary.h"

#include <algorithm>
#include <cmath>

#include "core/twice_double.h"

namespace asdfvk {
namespace {

constexpr TwiceDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

struct SineAndCosine {
  TwiceDouble sine, cosine;
};

/// Taylor series. Precondition: |r| <= pi / 4.
SineAndCosine seriesOf(const TwiceDouble& r) {
  const TwiceDouble square = r * r;
  TwiceDouble sine = 1, cosine = 1;
  for (int i = 26; i > 0; i -= 2) {  // Horner's scheme; the last term is below 2^-106.
    sine = 1 - square * sine / TwiceDouble(i * (i + 1.0));
    cosine = 1 - square * cosine / TwiceDouble(i * (i - 1.0));
  }
  return {r * sine, cosine};
}

SineAndCosine sineAndCosine(double radians) {
  const double quarters = std::nearbyint(radians / kHalfPi.high);
  const SineAndCosine rest = seriesOf(TwiceDouble(radians) - kHalfPi * TwiceDouble(quarters));
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return rest;
    case 1:
      return {rest.cosine, -rest.sine};
    case 2:
      return {-rest.sine, -rest.cosine};
    default:
      return {-rest.cosine, rest.sine};
  }
}

/// e^x. Precondition: |x| < 600.
TwiceDouble exponential(const TwiceDouble& x) {
  constexpr TwiceDouble kLogarithmOf2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  constexpr int kSquarings = 6;
  const double exponent = std::nearbyint(x.high / kLogarithmOf2.high);
  const TwiceDouble rest = (x - kLogarithmOf2 * TwiceDouble(exponent)) * TwiceDouble(1.0 / (1 << kSquarings));
  TwiceDouble sum = 1;
  for (int i = 14; i > 0; --i) sum = 1 + rest * sum / TwiceDouble(i);  // The first omitted term is below 2^-110.
  for (int i = 0; i < kSquarings; ++i) sum = sum * sum;
  return sum * TwiceDouble(std::scalbn(1.0, static_cast<int>(exponent)));
}

/// The natural logarithm of x, by Newton's method. Precondition: x > 0.
TwiceDouble logarithm(double x) {
  const double approximate = std::log(x);
  const TwiceDouble rest = TwiceDouble(x) * exponential(-approximate) - 1;
  return TwiceDouble(approximate) + (rest - rest * rest * 0.5);
}

}  // namespace

double sine(double radians) { return sineAndCosine(radians).sine.rounded(); }
double cosine(double radians) { return sineAndCosine(radians).cosine.rounded(); }

double angleOf(double y, double x) {
  const double approximate = std::atan2(y, x), size = std::max(std::abs(x), std::abs(y));
  if (x == 0 || y == 0) return approximate;  // A multiple of pi / 2.
  const TwiceDouble scaledX = TwiceDouble(x) / size, scaledY = TwiceDouble(y) / size;
  const auto [sine, cosine] = sineAndCosine(approximate);
  // The tangent of the angle between the vector and the approximation, which is so small that it equals the angle.
  const TwiceDouble rest = (scaledY * cosine - scaledX * sine) / (scaledX * cosine + scaledY * sine);
  return (TwiceDouble(approximate) + rest).rounded();
}

double power(double base, double exponent) { return exponential(logarithm(base) * exponent).rounded(); }

}  // namespace asdfvk
