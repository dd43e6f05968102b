// The scalars of a conjugate-gradient iteration, one description for every solver: in C++ a template over float and
// double, in GLSL float.
//
// One reduction per iteration (Meurant 1987, "Multitasking the conjugate gradient method on the CRAY X-MP/48"): besides
// p.Mp and r.r, the sums r.Mp and Mp.Mp give the next r.r before the step. Unlike the recurrence of Chronopoulos and
// Gear (1989), this one multiplies the direction itself and sums r.r in every iteration: in float32 it drifts no more
// than the textbook iteration, and it needs one vector less.
#ifndef ASDFVK_CG_RULES_H
#define ASDFVK_CG_RULES_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

const uint kCgRunning = 0u;
const uint kCgConverged = 1u;
const uint kCgBrokenDown = 2u;  // p.Mp or r.r is not positive, is rounding noise, or has overflowed.

const float kMaxCgSum = 3.0e38f;  // Larger sums have overflowed or are NaN.
const float kCgFloatRounding = 1.0e-7f;

#ifdef __cplusplus
#define ASDFVK_CG_FUNCTION [[nodiscard]] static
template <typename Real>
struct CgRules {
#else
#define ASDFVK_CG_FUNCTION
#define Real float
#endif

  // Sums over all rows, for the residual r, the direction p and its product Mp.
  struct CgSums {
    Real directionSquared;  // p.p
    Real productDot;        // p.Mp
    Real productSquared;    // Mp.Mp
    Real residualProduct;   // r.Mp
    Real residualDot;       // r.r
    Real residualSquared;   // r.r, each square times the residual weight of its row
  };

  // x += alpha p, r -= alpha Mp, p = r + beta p; no step unless `status` is kCgRunning.
  struct CgStep {
    Real alpha, beta;
    uint status;
  };

  // rounding: share of p.p at or below which p.Mp is rounding noise; a step by it would change x but not the residual.
  ASDFVK_CG_FUNCTION CgStep nextCgStep(CgSums sums, Real toleranceSquared, Real rounding) {
    CgStep next;
    next.alpha = Real(0);
    next.beta = Real(0);
    next.status = kCgConverged;
    if (sums.residualSquared <= toleranceSquared) return next;
    next.status = kCgBrokenDown;
    if (!(sums.residualSquared < kMaxCgSum && sums.residualDot > Real(0) && sums.residualDot < kMaxCgSum &&
          sums.productDot > rounding * sums.directionSquared && sums.productDot < kMaxCgSum))
      return next;
    const Real alpha = sums.residualDot / sums.productDot;
    // The next r.r divided by this one. Rounding can make it negative near convergence.
    const Real beta =
        Real(1) - alpha * ((Real(2) * sums.residualProduct - alpha * sums.productSquared) / sums.residualDot);
    if (!(alpha < kMaxCgSum && beta < kMaxCgSum)) return next;
    next.alpha = alpha;
    next.beta = beta > Real(0) ? beta : Real(0);
    next.status = kCgRunning;
    return next;
  }

#ifdef __cplusplus
};
}  // namespace asdfvk
#else
#undef Real
#endif
#undef ASDFVK_CG_FUNCTION

#endif
