// What the kernels of the equation on a graph (shaders/poisson/equation_*.comp) share with the host. Included by C++
// and by GLSL.
//
// The unknowns are differences from a base value of each face, in units in which values and weights are about 1.
// Between faces that a guiding field joins, the field is the base, and its divergence cancels: what is left is the sum
// of w_fg (e_g - e_f) over differences e, which float32 resolves.
#ifndef ASDFVK_EQUATION_LAYOUT_H
#define ASDFVK_EQUATION_LAYOUT_H

#ifdef __cplusplus
#include <cstddef>

#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

// Per face, 8 bytes. A NaN by its bits: a device may assume that there are none.
struct EquationStart {
  float base;        // NaN: EquationPush.missingBase.
  float difference;  // Of the constraint from the base; NaN for an unknown.
};

struct EquationPush {
  uint faceCount;
  uint workgroupCount;  // Of the dispatch.
  uint isGuided;        // 1: the equation has the divergence of the bases, where two neighbours have one.
  float missingBase;
  float scale;  // Factor of residuals and corrections.
};

#ifdef __cplusplus
static_assert(sizeof(EquationStart) == 8 && offsetof(EquationStart, difference) == 4);
static_assert(sizeof(EquationPush) == 20);
static_assert(offsetof(EquationPush, faceCount) == 0 && offsetof(EquationPush, workgroupCount) == 4);
static_assert(offsetof(EquationPush, isGuided) == 8 && offsetof(EquationPush, missingBase) == 12);
static_assert(offsetof(EquationPush, scale) == 16);
}  // namespace asdfvk
#endif

#endif
