// Tolerances in the definition of the shape diameter, the same for every backend; included by C++ and by GLSL.
#ifndef ASDFVK_CONE_RULES_H
#define ASDFVK_CONE_RULES_H

#ifdef __cplusplus
namespace asdfvk {
#endif

// Slack of the false-hit rule. A hit is false, and its ray dropped, if cos(a) > cos(b) + kFalseHitSlack. Here a is the
// angle between the normals of seed face and hit face, and b the false-hit angle. At the default of 90 degrees the
// slack is 0.06 degrees, so that hits on perpendicular walls do not depend on rounding. Without it 3.6 % of the faces
// of a CAD part changed with the last bit of a normal.
const float kFalseHitSlack = 1e-3f;

// A length is kept if |length - median| <= deviations * spread + kOutlierSlack * median (OutlierRule in
// src/cone/cone.h). With the slack, ties do not depend on rounding; two rays are always a tie.
const float kOutlierSlack = 1e-5f;

// Where faces touch, a ray from inside must leave its own part before it enters the touching part. A face that is hit
// on its outer side therefore counts as farther away by this many contact distances (Cone in src/cone/cone.h). The two
// faces are less than one contact distance apart, but a ray that meets them at an angle travels farther between them.
const float kOuterSideFactor = 8.0f;

#ifdef __cplusplus
}  // namespace asdfvk
#endif

#endif
