#version 450
// A ray per lane: each lane traverses the hierarchy independently.
#extension GL_GOOGLE_include_directive : require
#define FIND_NEAREST_HIT findNearestHit
#include "trace_rays.glsl"
