// Structs shared by the kernels of the Poisson solvers and the host, and the scalars of a conjugate-gradient iteration.
//
// The system with the matrix A is solved in the scaled form (I - S) y = b with S = I - D^-1/2 A D^-1/2, where D is the
// diagonal of A. The diagonal of S is 0. Conjugate gradients on this form equal Jacobi-preconditioned conjugate
// gradients on A, without a division.
#ifndef ASDFVK_POISSON_LAYOUT_H
#define ASDFVK_POISSON_LAYOUT_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

// A row of S, two blocks of 16 bytes: the first three entries of the row, and the location of further entries. Rows of
// manifold meshes have no further entries. An absent entry has coupling 0, and its column is the index of the row.
const uint kPoissonRowBlockCount = 2u;
const uint kPoissonRowHeadLength = 3u;  // Entries in the row itself.
struct PoissonRow {
  uint column0, column1, column2;
  uint tailBegin;  // Index into the arrays of further columns and couplings.
  float coupling0, coupling1, coupling2;
  uint tailCount;
};

// Each workgroup writes one partial sum per scalar, and adds the partial sums of all workgroups.
const uint kMaxPoissonWorkgroupCount = 256u;

// State of the iteration, 16 bytes. An iteration reads one of two states and writes the other, so that no workgroup
// reads a word that another workgroup writes.
struct CgState {
  float residualSquared;   // Squared weighted norm of the residual before the last iteration; 1 at the start.
  float toleranceSquared;  // The iteration has converged if residualSquared is at most this number.
  uint iterationCount;
  uint status;  // kCgRunning, or the reason of the end.
};

// Operand of vkCmdDispatchIndirect, 12 bytes. x becomes 0 at the end of the run: the remaining iterations do nothing.
struct DispatchSize {
  uint x, y, z;
};

// One partial sum per workgroup of each of the CgSums, 6144 bytes.
struct PoissonSums {
  float directionSquared[kMaxPoissonWorkgroupCount];
  float productDot[kMaxPoissonWorkgroupCount];
  float productSquared[kMaxPoissonWorkgroupCount];
  float residualProduct[kMaxPoissonWorkgroupCount];
  float residualDot[kMaxPoissonWorkgroupCount];
  float residualSquared[kMaxPoissonWorkgroupCount];
};

struct PoissonPush {
  uint unknownCount;
  uint stateIndex;  // The CgState that this iteration reads. The iteration writes the other CgState.
  // Number of workgroups of a dispatch that is not empty. gl_NumWorkGroups cannot replace this number: some drivers
  // load gl_NumWorkGroups while the kernel runs, from the DispatchSize that cg_step.comp overwrites.
  uint workgroupCount;
};

// Conjugate gradients with one reduction per iteration (Meurant 1987, "Multitasking the conjugate gradient method on
// the CRAY X-MP/48"): besides p.Mp and r.r, each iteration computes r.Mp and Mp.Mp. These sums give the next r.r before
// the step is made. The recurrence of Chronopoulos and Gear (1989) multiplies the residual by the matrix. Here, the
// matrix multiplies the direction, and every iteration sums r.r. This iteration needs one vector fewer. In float32 its
// drift is not larger than that of the textbook iteration.
const uint kCgRunning = 0u;
const uint kCgConverged = 1u;
const uint kCgBrokenDown = 2u;  // p.Mp or r.r is not positive, consists of rounding errors, or has overflowed.

const float kMaxCgSum = 3.0e38f;  // Larger sums have overflowed.
const float kCgFloatRounding = 1.0e-7f;

#ifdef __cplusplus
#define ASDFVK_CG_FUNCTION [[nodiscard]] static
// The sums of one iteration of the conjugate gradient method, and the rules that compute the next step from them. All
// solvers by conjugate gradients use these rules: C++ for float and double (template), GLSL for float.
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

  // x += alpha p, r -= alpha Mp, p = r + beta p. The step is made only if `status` is kCgRunning.
  struct CgStep {
    Real alpha, beta;
    uint status;
  };

  // Whether |sum| is below kMaxCgSum; false for NaN. GLSL tests the bits, because devices may assume that no NaN
  // occurs.
  ASDFVK_CG_FUNCTION bool isBounded(Real sum) {
#ifdef __cplusplus
    return sum > -kMaxCgSum && sum < kMaxCgSum;
#else
  return (floatBitsToUint(sum) & 0x7fffffffu) < floatBitsToUint(kMaxCgSum);
#endif
  }

  // rounding: if p.Mp is at most this share of p.p, p.Mp is a rounding error. A step with this p.Mp would change x but
  // not the residual.
  ASDFVK_CG_FUNCTION CgStep nextCgStep(CgSums sums, Real toleranceSquared, Real rounding) {
    CgStep next;
    next.alpha = Real(0);
    next.beta = Real(0);
    next.status = kCgBrokenDown;
    if (!isBounded(sums.residualSquared)) return next;
    if (sums.residualSquared <= toleranceSquared) {
      next.status = kCgConverged;
      return next;
    }
    if (!(isBounded(sums.residualDot) && isBounded(sums.directionSquared) && isBounded(sums.productDot))) return next;
    if (!(sums.residualDot > Real(0) && sums.productDot > rounding * sums.directionSquared)) return next;
    const Real alpha = sums.residualDot / sums.productDot;
    // The ratio of the next r.r to the current r.r. Rounding can make a tiny ratio negative.
    const Real beta =
        Real(1) - alpha * ((Real(2) * sums.residualProduct - alpha * sums.productSquared) / sums.residualDot);
    if (!(isBounded(alpha) && isBounded(beta))) return next;
    next.alpha = alpha;
    next.beta = beta > Real(0) ? beta : Real(0);
    next.status = kCgRunning;
    return next;
  }

#ifdef __cplusplus
};

static_assert(sizeof(PoissonRow) == 16 * kPoissonRowBlockCount);
static_assert(sizeof(CgState) == 16);
static_assert(sizeof(DispatchSize) == 12);
static_assert(sizeof(PoissonSums) == 6144);
static_assert(sizeof(PoissonPush) == 12);
}  // namespace asdfvk
#else
#undef Real

PoissonRow decodePoissonRow(uvec4 t0, uvec4 t1) {
  const vec3 couplings = uintBitsToFloat(t1.xyz);
  return PoissonRow(t0.x, t0.y, t0.z, t0.w, couplings.x, couplings.y, couplings.z, t1.w);
}
#endif
#undef ASDFVK_CG_FUNCTION

#endif
