#version 450
// Packets (ASDF paper, section 6): the lanes of a subgroup traverse the hierarchy together. The lanes have the rays of
// one cone, or of several cones with few rays.
#extension GL_GOOGLE_include_directive : require
#define FIND_NEAREST_HIT findNearestHitTogether
#define WALKS_TOGETHER
#include "trace_rays.glsl"
