#version 450
// Lane = ray: each lane of a cone walks the hierarchy on its own.
#extension GL_GOOGLE_include_directive : require
#define FIND_NEAREST_HIT findNearestHit
#include "cone_lanes.glsl"
