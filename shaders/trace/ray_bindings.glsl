// The interface of the kernels that trace rays: specialization constants, bindings 4 to 7 and push constants. Bindings
// 0 to 3 are in bvh_fetch.glsl. Workgroup (x, y) traces kLanesPerCone rays of each of kConesPerWorkgroup cones,
// beginning with ray y * kLanesPerCone. With one lane per cone, neighbouring lanes trace the same ray of neighbouring
// seeds; such rays visit nearly the same nodes.
#include "shared/cone_layout.h"
#include "shared/node_arithmetic.h"
#include "shared/specialization_ids.h"

layout(local_size_x_id = kLocalSizeXId) in;  // Equal to kLanesPerCone * kConesPerWorkgroup.
layout(constant_id = kLanesPerConeId) const uint kLanesPerCone = 1;
layout(constant_id = kConesPerWorkgroupId) const uint kConesPerWorkgroup = 64;
layout(constant_id = kRayCountId) const uint kRayCount = 30;
layout(constant_id = kIterationLimitId) const uint kIterationLimit = 8000;
layout(constant_id = kWritesHitsId) const bool kWritesHits = false;
layout(constant_id = kIsCgalId) const bool kIsCgal = false;
layout(constant_id = kNodeArithmeticId) const uint kNodeArithmetic = kMaskedBytes;

layout(set = 0, binding = 4, rgba32ui) uniform readonly uimageBuffer rayTexels;
layout(set = 0, binding = 5, rgba32ui) uniform readonly uimageBuffer originTexels;
layout(set = 0, binding = 6) writeonly buffer Lengths { uint lengths[]; };  // The bits of coneCount lengths per ray.
layout(set = 0, binding = 7) writeonly buffer Hits { uvec2 hits[]; };  // ConeHit, kRayCount per cone, if kWritesHits.
layout(push_constant) uniform Push { ConePush push; };
