// Data that the kernels of the Poisson solvers share with the host; included by C++ and by GLSL.
//
// The system A is solved in the scaled form (I - S) y = b with S = I - D^-1/2 A D^-1/2, D the diagonal of A, so that
// the diagonal of S is 0. Conjugate gradients on it are Jacobi-preconditioned conjugate gradients on A, without a
// vector to divide by.
#ifndef ASDFVK_POISSON_LAYOUT_H
#define ASDFVK_POISSON_LAYOUT_H

#ifdef __cplusplus
#include <cstddef>
#endif

#include "shared/cg_rules.h"

#ifdef __cplusplus
namespace asdfvk {
#endif

// A row of S, 32 bytes, read as two rgba32ui texels: its first three entries, which are all of them on a manifold mesh,
// and the position of the further ones. Absent entries have coupling 0 and the column of the row itself.
const uint kPoissonRowTexelCount = 2u;
struct PoissonRow {
  uint column0, column1, column2;
  uint tailBegin;  // Into the arrays of further columns and couplings.
  float coupling0, coupling1, coupling2;
  uint tailCount;
};

// Each workgroup writes one partial sum per scalar, and each workgroup adds all of them.
const uint kMaxPoissonWorkgroupCount = 256u;

// The scalars of the iteration, 16 bytes. There are two states: an iteration reads one and writes the other, so that no
// workgroup reads a word that another one writes.
struct CgState {
  float residualSquared;   // The squared norm of the unscaled residual before the last iteration; 1 at the start.
  float toleranceSquared;  // At or below this residualSquared it has converged.
  uint iterationCount;
  uint status;  // See cg_rules.h; unless kCgRunning, there are no more iterations.
};

// Arguments of vkCmdDispatchIndirect, 12 bytes. The last iteration sets x to 0, so that iterations recorded after it
// take almost no time.
struct DispatchSize {
  uint x, y, z;
};

// One partial sum per workgroup, all as in CgSums, 6144 bytes.
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
  uint stateIndex;  // The CgState that this iteration reads; it writes the other one.
};

#ifdef __cplusplus
static_assert(sizeof(PoissonRow) == 16 * kPoissonRowTexelCount);
static_assert(offsetof(PoissonRow, column0) == 0 && offsetof(PoissonRow, column1) == 4);
static_assert(offsetof(PoissonRow, column2) == 8 && offsetof(PoissonRow, tailBegin) == 12);
static_assert(offsetof(PoissonRow, coupling0) == 16 && offsetof(PoissonRow, coupling1) == 20);
static_assert(offsetof(PoissonRow, coupling2) == 24 && offsetof(PoissonRow, tailCount) == 28);
static_assert(sizeof(CgState) == 16);
static_assert(offsetof(CgState, residualSquared) == 0 && offsetof(CgState, toleranceSquared) == 4);
static_assert(offsetof(CgState, iterationCount) == 8 && offsetof(CgState, status) == 12);
static_assert(sizeof(DispatchSize) == 12);
static_assert(offsetof(DispatchSize, x) == 0 && offsetof(DispatchSize, y) == 4 && offsetof(DispatchSize, z) == 8);
static_assert(sizeof(PoissonSums) == 6144);
static_assert(offsetof(PoissonSums, directionSquared) == 0 && offsetof(PoissonSums, productDot) == 1024);
static_assert(offsetof(PoissonSums, productSquared) == 2048 && offsetof(PoissonSums, residualProduct) == 3072);
static_assert(offsetof(PoissonSums, residualDot) == 4096 && offsetof(PoissonSums, residualSquared) == 5120);
static_assert(sizeof(PoissonPush) == 8);
static_assert(offsetof(PoissonPush, unknownCount) == 0 && offsetof(PoissonPush, stateIndex) == 4);
}  // namespace asdfvk
#else
PoissonRow decodePoissonRow(uvec4 t0, uvec4 t1) {
  const vec3 couplings = uintBitsToFloat(t1.xyz);
  return PoissonRow(t0.x, t0.y, t0.z, t0.w, couplings.x, couplings.y, couplings.z, t1.w);
}
#endif

#endif
