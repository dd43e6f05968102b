// Structs that the kernels of the equation on a graph (shaders/poisson/equation_*.comp) share with the host.
//
// The unknowns are differences from a base value of each face, in units in which values and weights are about 1.
// Between two guided faces, the bases are the values of the guiding field; then the divergence of the field cancels.
// The sum of w_fg (e_g - e_f) over the differences e remains, for which float32 is precise enough.
#ifndef ASDFVK_EQUATION_LAYOUT_H
#define ASDFVK_EQUATION_LAYOUT_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

// Per face, 12 bytes.
struct EquationStart {
  float base;
  float difference;  // Difference of the constraint from the base; 0 for an unknown.
  uint flags;
};
const uint kIsUnknown = 1u;
const uint kIsGuided = 2u;  // The equation includes the divergence of the bases between two guided faces.

struct EquationPush {
  uint faceCount;
  uint workgroupCount;  // Workgroups of the dispatch.
  float scale;          // Factor of residuals and corrections.
};

#ifdef __cplusplus
static_assert(sizeof(EquationStart) == 12);
static_assert(sizeof(EquationPush) == 12);
}  // namespace asdfvk
#endif

#endif
