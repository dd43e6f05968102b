#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"
#include "mesh/dual_graph.h"

namespace asdfvk {

/// Unit normals of the faces without the noise of the vertices, by the bilateral filter of Zheng, Fu, Au and Tai
/// (Bilateral Normal Filtering for Mesh Denoising, TVCG 2011). The noise is estimated from the normals: the median
/// distance of a normal from the mean of its neighbours. Edges that are sharp in comparison with the noise remain, and
/// a mesh with little noise or with fewer than 1,000 faces keeps its normals. normals: #F, zero for a degenerate face.
/// areas: #F, the weights.
[[nodiscard]] std::vector<Vec3d> filterNormals(std::span<const Vec3d> normals, std::span<const float> areas,
                                               const DualGraph& graph);

}  // namespace asdfvk
