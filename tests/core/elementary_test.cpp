#include "core/elementary.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace asdfvk {
namespace {

/// Half a unit in the last place, and a little more: the reference is a long double.
void checkRounded(double value, long double reference) {
  CHECK(std::abs(value - reference) <= 0.501L * std::scalbn(1.0L, std::ilogb(value) - 52));
}

}  // namespace

TEST_CASE("elementary functions are rounded to the nearest double") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double x = (random.real() - 0.5) * 5000, y = random.real() - 0.5, z = 4 * random.real() + 1e-3;
    checkRounded(sine(x), std::sin(static_cast<long double>(x)));
    checkRounded(cosine(x), std::cos(static_cast<long double>(x)));
    checkRounded(angleOf(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
    checkRounded(power(z, 8 * y), std::pow(static_cast<long double>(z), static_cast<long double>(8 * y)));
  }
}

TEST_CASE("elementary functions of special angles") {
  CHECK(sine(0) == 0);
  CHECK(cosine(0) == 1);
  CHECK(cosine(std::numbers::pi) == -1);
  CHECK(cosine(std::numbers::pi / 3) == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(angleOf(0, 1) == 0);
  CHECK(angleOf(0, -1) == std::numbers::pi);
  CHECK(angleOf(1, 0) == std::numbers::pi / 2);
  CHECK(angleOf(-1e-300, -1e-300) == -3 * std::numbers::pi / 4);
  CHECK(power(2, 10) == 1024);
  CHECK(power(9, 0.5) == 3);
}

}  // namespace asdfvk
