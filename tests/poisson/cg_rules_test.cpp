#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>

#include "shared/poisson_layout.h"

using namespace asdfvk;

namespace {

using CgSums = CgRules<float>::CgSums;
using CgStep = CgRules<float>::CgStep;

CgStep nextCgStep(const CgSums& sums, float toleranceSquared) {
  return CgRules<float>::nextCgStep(sums, toleranceSquared, kCgFloatRounding);
}

constexpr CgSums kSound{.directionSquared = 9,
                        .productDot = 4,
                        .productSquared = 3,
                        .residualProduct = 3.5f,
                        .residualDot = 8,
                        .residualSquared = 1};

}  // namespace

TEST_CASE("a step's scalars are worked out by hand, that of the next direction from the residual to come") {
  // alpha = 8 / 4; |r - alpha Mp|^2 = 8 - 2 * 2 * 3.5 + 4 * 3 = 6, over 8.
  const CgStep next = nextCgStep(kSound, 0.5f);
  CHECK(next.status == kCgRunning);
  CHECK(next.alpha == 2);
  CHECK(next.beta == 0.75f);
}

TEST_CASE("a residual to come that rounding makes negative counts as nothing") {
  CgSums sums = kSound;
  sums.productSquared = 1;
  const CgStep next = nextCgStep(sums, 0.5f);
  CHECK(next.status == kCgRunning);
  CHECK(next.beta == 0);
}

TEST_CASE("it has converged at the tolerance, whatever the other sums say") {
  for (float product : {4.0f, 0.0f, -1.0f}) {
    CgSums sums = kSound;
    sums.productDot = product;
    CHECK(nextCgStep(sums, 1).status == kCgConverged);
    CHECK(nextCgStep(sums, 0.5f).status == (product > 0 ? kCgRunning : kCgBrokenDown));
  }
}

TEST_CASE("a product that is no more than rounding of its direction breaks it down") {
  CgSums sums = kSound;
  sums.directionSquared = 3e7f;
  CHECK(nextCgStep(sums, 0.5f).status == kCgRunning);
  sums.directionSquared = 5e7f;
  CHECK(nextCgStep(sums, 0.5f).status == kCgBrokenDown);
}

TEST_CASE("sums that are no positive numbers, or have overflowed, break it down") {
  for (float bad : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (float CgSums::*sum : {&CgSums::directionSquared, &CgSums::productDot, &CgSums::productSquared,
                               &CgSums::residualProduct, &CgSums::residualDot, &CgSums::residualSquared}) {
      const bool isBad = bad != -1 || sum == &CgSums::productDot || sum == &CgSums::residualDot;
      if (!isBad || (bad > 0 && sum == &CgSums::residualProduct)) continue;  // It makes beta -infinity, which is 0.
      CgSums sums = kSound;
      sums.*sum = bad;
      const CgStep next = nextCgStep(sums, 0.5f);
      CHECK(next.status == kCgBrokenDown);
      CHECK(next.alpha == 0);
      CHECK(next.beta == 0);
    }
}
