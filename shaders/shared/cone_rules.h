// The numbers in the definition of the shape diameter that every backend shares; included by C++ and by GLSL.
#ifndef ASDFVK_CONE_RULES_H
#define ASDFVK_CONE_RULES_H

#ifdef __cplusplus
namespace asdfvk {
#endif

// A hit is false, and its ray dropped, where the cosine between the seed's and the hit face's normal is above this: "the
// angle is below 90 degrees" with a slack of 0.06 degrees, so that walls meant to be perpendicular do not depend on
// rounding (without it 3.6 % of the faces of a CAD part changed with the last bit of a normal).
const float kFalseHitCosine = 1e-3f;

// A length is kept when |length - median| <= standard deviation + this * median, so that ties (two rays are always a tie)
// do not depend on rounding.
const float kOutlierSlack = 1e-5f;

#ifdef __cplusplus
}  // namespace asdfvk
#endif

#endif
