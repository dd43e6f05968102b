// The slacks in the definition of the shape diameter, the same for every backend; included by C++ and by GLSL.
#ifndef ASDFVK_CONE_RULES_H
#define ASDFVK_CONE_RULES_H

#ifdef __cplusplus
namespace asdfvk {
#endif

// A hit is false, and its ray dropped, where the cosine between the seed's and the hit face's normal exceeds that of
// the angle asked for (90 degrees) by more than this (0.06 degrees there), so that walls meant to be perpendicular do
// not depend on rounding: without it 3.6 % of the faces of a CAD part changed with the last bit of a normal.
const float kFalseHitSlack = 1e-3f;

// A length is kept when |length - median| <= standard deviations + this * median, so that ties (two rays are always a
// tie) do not depend on rounding.
const float kOutlierSlack = 1e-5f;

#ifdef __cplusplus
}  // namespace asdfvk
#endif

#endif
