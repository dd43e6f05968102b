#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>

#include "shared/cg_rules.h"

using namespace asdfvk;

TEST_CASE("a step's scalars are worked out by hand, that of the next direction from the residual to come") {
  // alpha = 8 / 4; |r - alpha Mp|^2 = 8 - 2 * 2 * 4 + 4 * 3 = 4, over 8.
  const CgStep next = nextCgStep({.productDot = 4, .productSquared = 3, .residualDot = 8, .residualSquared = 1}, 0.5f);
  CHECK(next.status == kCgRunning);
  CHECK(next.alpha == 2);
  CHECK(next.beta == 0.5f);
}

TEST_CASE("a residual to come that rounding makes negative counts as nothing") {
  const CgStep next = nextCgStep({.productDot = 4, .productSquared = 1, .residualDot = 8, .residualSquared = 1}, 0.5f);
  CHECK(next.status == kCgRunning);
  CHECK(next.beta == 0);
}

TEST_CASE("it has converged at the tolerance, whatever the other sums say") {
  for (float product : {4.0f, 0.0f, -1.0f}) {
    const CgSums sums{.productDot = product, .productSquared = 3, .residualDot = 8, .residualSquared = 0.5f};
    CHECK(nextCgStep(sums, 0.5f).status == kCgConverged);
    CHECK(nextCgStep(sums, 0.25f).status == (product > 0 ? kCgRunning : kCgBrokenDown));
  }
}

TEST_CASE("sums that are no positive numbers, or have overflowed, break it down") {
  const CgSums sound{.productDot = 4, .productSquared = 3, .residualDot = 8, .residualSquared = 1};
  for (float bad : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (float CgSums::* sum :
         {&CgSums::productDot, &CgSums::productSquared, &CgSums::residualDot, &CgSums::residualSquared}) {
      if (bad == -1 && (sum == &CgSums::productSquared || sum == &CgSums::residualSquared)) continue;
      CgSums sums = sound;
      sums.*sum = bad;
      const CgStep next = nextCgStep(sums, 0.5f);
      CHECK(next.status == kCgBrokenDown);
      CHECK(next.alpha == 0);
      CHECK(next.beta == 0);
    }
}
