#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>
#include <type_traits>

#include "shared/poisson_layout.h"

using namespace asdfvk;

namespace {

template <typename Real>
struct Sample {
  using Sums = typename CgRules<Real>::CgSums;

  static constexpr Sums kSums{.directionSquared = 9,
                              .productDot = 4,
                              .productSquared = 3,
                              .residualProduct = Real(3.5),
                              .residualDot = 8,
                              .residualSquared = 1};
  static constexpr Real kRounding = std::is_same_v<Real, float> ? Real(1e-7) : Real(2e-16);

  static auto next(const Sums& sums, double toleranceSquared) {
    return CgRules<Real>::nextCgStep(sums, static_cast<Real>(toleranceSquared), kRounding);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("the scalars of a step are those computed by hand", Real, float, double) {
  // alpha = 8 / 4; |r - alpha Mp|^2 = 8 - 2 * 2 * 3.5 + 4 * 3 = 6, over 8.
  const auto next = Sample<Real>::next(Sample<Real>::kSums, 0.5);
  CHECK(next.status == kCgRunning);
  CHECK(next.alpha == 2);
  CHECK(next.beta == 0.75);
}

TEST_CASE_TEMPLATE("a next residual that rounding makes negative counts as 0", Real, float, double) {
  auto sums = Sample<Real>::kSums;
  sums.productSquared = 1;
  const auto next = Sample<Real>::next(sums, 0.5);
  CHECK(next.status == kCgRunning);
  CHECK(next.beta == 0);
}

TEST_CASE_TEMPLATE("the iteration has converged at the tolerance, for any other sums", Real, float, double) {
  for (Real product : {Real(4), Real(0), Real(-1)}) {
    auto sums = Sample<Real>::kSums;
    sums.productDot = product;
    CHECK(Sample<Real>::next(sums, 1).status == kCgConverged);
    CHECK(Sample<Real>::next(sums, 0.5).status == (product > 0 ? kCgRunning : kCgBrokenDown));
  }
}

TEST_CASE_TEMPLATE("a product that is only rounding of its direction is a breakdown", Real, float, double) {
  auto sums = Sample<Real>::kSums;
  sums.directionSquared = Real(0.75) * sums.productDot / Sample<Real>::kRounding;
  CHECK(Sample<Real>::next(sums, 0.5).status == kCgRunning);
  sums.directionSquared = Real(1.25) * sums.productDot / Sample<Real>::kRounding;
  CHECK(Sample<Real>::next(sums, 0.5).status == kCgBrokenDown);
}

TEST_CASE_TEMPLATE("sums that are not positive or have overflowed are a breakdown", Real, float, double) {
  using Sums = typename Sample<Real>::Sums;
  for (Real bad : {Real(-1), std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::quiet_NaN()})
    for (Real Sums::*sum : {&Sums::directionSquared, &Sums::productDot, &Sums::productSquared, &Sums::residualProduct,
                            &Sums::residualDot, &Sums::residualSquared}) {
      const bool isBad = bad != -1 || sum == &Sums::productDot || sum == &Sums::residualDot;
      if (!isBad || (bad > 0 && sum == &Sums::residualProduct)) continue;  // beta = -infinity counts as 0.
      auto sums = Sample<Real>::kSums;
      sums.*sum = bad;
      const auto next = Sample<Real>::next(sums, 0.5);
      CHECK(next.status == kCgBrokenDown);
      CHECK(next.alpha == 0);
      CHECK(next.beta == 0);
    }
}
