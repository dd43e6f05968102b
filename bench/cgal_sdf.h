#pragma once

#include <optional>

#include "mesh/mesh.h"

namespace asdfvk::bench {

/// Whether this build has CGAL, which is optional.
[[nodiscard]] bool hasCgal();

/// Seconds that CGAL's sdf_values() takes for every face at 30 rays and 120 degrees, without post-processing, on one
/// thread, as it is; its polyhedron is built before the clock starts. None without CGAL, or where the mesh is no
/// orientable 2-manifold.
[[nodiscard]] std::optional<double> cgalSeconds(const Mesh& mesh);

}  // namespace asdfvk::bench
