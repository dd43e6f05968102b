// What the bilateral smoothing shares between host and kernel; included by C++ and by GLSL.
#ifndef ASDFVK_BILATERAL_LAYOUT_H
#define ASDFVK_BILATERAL_LAYOUT_H

#ifdef __cplusplus
#include <cstddef>

#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

const uint kMaxBilateralWindow = 4u;
// The four rings of a face whose edges join two faces each have at most 1 + 3 + 6 + 12 + 24 = 46 faces, found along 66
// arcs. Where more faces meet at an edge, a window ends here. The two also bound the iterations of the kernel: 96 * 64
// times the 8 lanes that it counts together are below the 65,535 after which Mesa's CPU device ends loops silently.
const uint kMaxWindowFaceCount = 64u;
const uint kMaxWindowArcCount = 96u;

// Values reach the kernel scaled into -1..1.
const float kNoScaledValue = 4.0;

struct BilateralPush {
  uint firstFace;  // Of this dispatch.
  uint faceCount;  // Of the mesh.
  uint window;
};

#ifdef __cplusplus
static_assert(sizeof(BilateralPush) == 12);
static_assert(offsetof(BilateralPush, firstFace) == 0 && offsetof(BilateralPush, faceCount) == 4);
static_assert(offsetof(BilateralPush, window) == 8);
}  // namespace asdfvk
#endif

#endif
