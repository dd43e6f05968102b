// The scalars of a conjugate-gradient iteration, the same on every backend; included by C++ and by GLSL.
//
// One reduction per iteration (after Meurant 1987, "Multitasking the conjugate gradient method on the CRAY X-MP/48"):
// beside p.Mp and r.r also r.Mp and |Mp|^2 are summed, which tell r.r after the step before the step is taken. Unlike
// in the recurrence of Chronopoulos and Gear (1989) the product is that of the direction itself and r.r is summed anew
// each time, so that in float32 nothing drifts that does not in the textbook's iteration, and there is one vector less.
#ifndef ASDFVK_CG_RULES_H
#define ASDFVK_CG_RULES_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

const uint kCgRunning = 0u;
const uint kCgConverged = 1u;
const uint kCgBrokenDown = 2u;  // p.Mp or r.r is no positive number that counts: float32 has no more to give.

const float kLargestCgSum = 3.0e38f;  // What is not below has overflowed, or is not a number.
// p.Mp at or below this share of p.p is rounding, and a step by it would carry x off without the residual showing it.
const float kCgRounding = 1.0e-7f;

// Over all rows, for the residual r, the direction p and its product Mp.
struct CgSums {
  float directionSquared;  // p.p
  float productDot;        // p.Mp
  float productSquared;    // Mp.Mp
  float residualProduct;   // r.Mp
  float residualDot;       // r.r
  float residualSquared;   // r.r, each square times the row's residual weight.
};

// x += alpha p, r -= alpha Mp, p = r + beta p; nothing at all unless `status` is kCgRunning.
struct CgStep {
  float alpha, beta;
  uint status;
};

#ifdef __cplusplus
[[nodiscard]] inline
#endif
    CgStep
    nextCgStep(CgSums sums, float toleranceSquared) {
  CgStep next;
  next.alpha = 0.0f;
  next.beta = 0.0f;
  next.status = kCgConverged;
  if (sums.residualSquared <= toleranceSquared) return next;
  next.status = kCgBrokenDown;
  if (!(sums.residualSquared < kLargestCgSum && sums.residualDot > 0.0f && sums.residualDot < kLargestCgSum &&
        sums.productDot > kCgRounding * sums.directionSquared && sums.productDot < kLargestCgSum))
    return next;
  const float alpha = sums.residualDot / sums.productDot;
  // r.r to come over the present one. Where rounding makes it negative hardly anything is left.
  const float beta = 1.0f - alpha * ((2.0f * sums.residualProduct - alpha * sums.productSquared) / sums.residualDot);
  if (!(alpha < kLargestCgSum && beta < kLargestCgSum)) return next;
  next.alpha = alpha;
  next.beta = beta > 0.0f ? beta : 0.0f;
  next.status = kCgRunning;
  return next;
}

#ifdef __cplusplus
}  // namespace asdfvk
#endif

#endif
