#include "mesh/normalization.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

using namespace asdfvk;

namespace {

Box3d box(const Vec3d& min, const Vec3d& max) {
  Box3d result;
  result.add(min);
  result.add(max);
  return result;
}

}  // namespace

TEST_CASE("normalisation brings the largest half extent into [0.5, 1] by a power of two") {
  for (const double scale : {1e-300, 1e-150, 1e-30, 0.7, 1.0, 3.0, 1e3, 1e30, 1e300}) {
    CAPTURE(scale);
    const Normalization normalization = normalizationOf(box({-scale, 0, 0}, {3 * scale, scale, -scale}));
    int exponent = 0;
    CHECK(std::frexp(normalization.scale, &exponent) == 0.5);
    const Vec3d low = normalization.toNormalized({-scale, 0, 0}), high = normalization.toNormalized({3 * scale, 0, 0});
    CHECK(high.x >= 0.5);
    CHECK(high.x <= 1);
    CHECK(low.x == doctest::Approx(-high.x));
    CHECK(normalization.toMeshLength(high.x - low.x) == doctest::Approx(4 * scale));
  }
}

TEST_CASE("a shift that the numbers resolve does not change normalised coordinates") {
  const Normalization near = normalizationOf(box({-1, -1, -1}, {1, 1, 1}));
  const Normalization far = normalizationOf(box({1e9 - 1, -1, -1}, {1e9 + 1, 1, 1}));
  CHECK(far.scale == near.scale);
  CHECK(far.toNormalized({1e9 + 0.5, 0.25, 0}) == near.toNormalized({0.5, 0.25, 0}));
}

TEST_CASE("a point, an empty box and subnormal extents have a usable scale") {
  CHECK(normalizationOf(box({5, 5, 5}, {5, 5, 5})).scale == 1);
  CHECK(normalizationOf(box({5, 5, 5}, {5, 5, 5})).toNormalized({5, 5, 5}) == Vec3d{});
  CHECK(normalizationOf(Box3d{}).scale == 1);
  const double tiny = std::numeric_limits<double>::denorm_min();
  CHECK(std::isfinite(normalizationOf(box({0, 0, 0}, {tiny * 8, 0, 0})).scale));
}

TEST_CASE("a box as wide as a double's range maps into [-1, 1] and its lengths stay finite") {
  const double edge = 1.7e308;
  const Normalization normalization = normalizationOf(box({-edge, -edge, 0}, {edge, edge, 1}));
  for (const double sign : {-1.0, 1.0}) {
    const Vec3d corner = normalization.toNormalized({sign * edge, -sign * edge, 0});
    CHECK(std::abs(corner.x) >= 0.5);
    CHECK(std::abs(corner.x) <= 1);
    CHECK(corner.y == -corner.x);
  }
  CHECK(normalization.toMeshLength(0.25) == doctest::Approx(0.25 / normalization.scale));
  CHECK(normalization.toMeshLength(2) == std::numeric_limits<double>::max());
  CHECK(std::isnan(normalization.toMeshLength(std::numeric_limits<double>::quiet_NaN())));
}
