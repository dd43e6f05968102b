// Tolerances in the definition of the shape diameter, the same for every backend.
#ifndef ASDFVK_CONE_RULES_H
#define ASDFVK_CONE_RULES_H

#ifdef __cplusplus
namespace asdfvk {
#endif

// Slack of the false-hit rule: a ray is dropped if cos(a) > cos(b) + kFalseHitSlack. a: angle between the normals of
// seed face and hit face. b: false-hit angle. The slack is 0.06 degrees at the default of 90 degrees. Hits on
// perpendicular walls therefore do not depend on rounding. Without the slack, 3.6 % of the faces of a CAD part changed
// with the last bit of a normal.
const float kFalseHitSlack = 1e-3f;

// A length is kept if |length - median| <= deviations * spread + kOutlierSlack * median (OutlierRule in
// src/cone/cone.h). Because of the slack, ties do not depend on rounding; two rays are always a tie.
const float kOutlierSlack = 1e-5f;

// Where two parts touch, a ray from inside must leave its own part before it enters the other part. A face that is hit
// on its outer side therefore counts as farther away by this many contact distances (Cone in src/cone/cone.h). The
// touching faces are less than one contact distance apart, but an oblique ray travels farther between them.
const float kOuterSideFactor = 8.0f;

#ifdef __cplusplus
}  // namespace asdfvk
#endif

#endif
