// Ids of the specialization constants of all kernels. The constant `kRayCount` of a kernel has the id `kRayCountId`,
// and the host sets it by this name (SpecializationConstant in src/vk/compute_pipeline.h). An id means the same in
// every kernel, so that kernels with shared GLSL files have one list of values.
#ifndef ASDFVK_SPECIALIZATION_IDS_H
#define ASDFVK_SPECIALIZATION_IDS_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

// Lanes per workgroup: local_size_x_id. Metal refuses a constant that shares this id. A kernel that computes with the
// size therefore has a further constant of the same value.
const uint kLocalSizeXId = 0u;
const uint kLaneCountId = 1u;            // Lanes per workgroup, for the kernels of the equation.
const uint kLanesPerConeId = 2u;         // Lanes with rays of one cone.
const uint kConesPerWorkgroupId = 3u;    // Cones whose rays a workgroup traces.
const uint kRayCountId = 4u;             // Rays per cone.
const uint kLengthCountId = 5u;          // Size of an array of lengths, equal to kRayCount.
const uint kIterationLimitId = 6u;       // Greatest number of loop iterations per ray.
const uint kWritesHitsId = 7u;           // Whether the kernel writes the hit of each ray.
const uint kFetchesTexelsId = 8u;        // True: BvhFetch::Texel. False: BvhFetch::Storage.
const uint kIsCgalId = 9u;               // True: Definition::Cgal. False: Definition::Paper.
const uint kStackSizeId = 10u;           // VulkanWalkShape::stackSize.
const uint kPostponesTrianglesId = 11u;  // VulkanWalkShape::postponesTriangles.
const uint kNodeArithmeticId = 12u;      // VulkanWalkShape::arithmetic.

#ifdef __cplusplus
}  // namespace asdfvk
#endif

#endif
