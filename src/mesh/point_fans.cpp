#include "mesh/point_fans.h"

#include <numeric>
#include <tuple>

#include "core/parallel.h"

namespace asdfvk {

PointFans::PointFans(const TriangleMesh& mesh)
    : pointOf_(mesh.vertices.size()), first_(mesh.vertices.size() + 1), corners_(3 * size_t{mesh.faceCount()}) {
  std::vector<uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t vertex) {
    const Vec3d& p = mesh.vertices[vertex];
    return std::tuple(p.x, p.y, p.z, vertex);
  };
  std::erase_if(order, [&](uint32_t vertex) { return !isFinite(mesh.vertices[vertex]); });
  sortInParallel(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  std::iota(pointOf_.begin(), pointOf_.end(), 0u);
  for (size_t i = 1; i < order.size(); ++i)
    if (mesh.vertices[order[i]] == mesh.vertices[order[i - 1]]) pointOf_[order[i]] = pointOf_[order[i - 1]];
  for (const Face& face : mesh.faces)
    for (const uint32_t vertex : face) ++first_[pointOf_[vertex] + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (uint32_t k = 0; k < 3; ++k) corners_[next[pointOf_[mesh.faces[face][k]]]++] = 3 * face + k;
}

}  // namespace asdfvk
