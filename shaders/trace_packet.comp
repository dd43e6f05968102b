#version 450
// Packets: the lanes of a subgroup walk the hierarchy together, with the rays of one cone (or of a few cones where they
// are few), as the ASDF paper's section 6 asks for.
#extension GL_GOOGLE_include_directive : require
#define FIND_NEAREST_HIT findNearestHitTogether
#define WALKS_TOGETHER
#include "cone_lanes.glsl"
