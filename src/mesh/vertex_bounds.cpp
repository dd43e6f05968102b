#include "mesh/vertex_bounds.h"

#include "core/parallel.h"

namespace asdfvk {

Box3d boundsOfFiniteVertices(const TriangleMesh& mesh) {
  const auto boundRange = [&](const tbb::blocked_range<size_t>& range, Box3d bounds) {
    for (size_t i = range.begin(); i < range.end(); ++i)
      if (isFinite(mesh.vertices[i])) bounds.add(mesh.vertices[i]);
    return bounds;
  };
  return tbb::parallel_reduce(tbb::blocked_range<size_t>(0, mesh.vertices.size(), kItemsPerTask), Box3d{}, boundRange,
                              joined);
}

}  // namespace asdfvk
