#include "page/half_edges.h"

#include <compare>
#include <span>

#include "core/buckets.h"

namespace asdfvk {
namespace {

/// A half-edge in the bucket of the lower one of its vertices.
struct Side {
  uint32_t higherVertex, halfEdge;
  auto operator<=>(const Side&) const = default;
};

}  // namespace

std::vector<uint32_t> pairHalfEdges(const TriangleMesh& mesh) {
  const StagedEntries<Side> sides(mesh.vertices.size(), mesh.faces.size(), [&](uint32_t f, const auto& put) {
    if (!isConnectable(mesh, f)) return;
    const Face& face = mesh.faces[f];
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t a = face[i], b = face[i == 2 ? 0 : i + 1];
      put(std::min(a, b), Side{std::max(a, b), 3 * f + i});
    }
  });
  std::vector<uint32_t> opposite(3 * mesh.faces.size(), kNone);
  sides.forEachBucket([&](uint32_t lower, std::span<const Side> entries) {
    const auto leaves = [&](const Side& side) { return mesh.faces[side.halfEdge / 3][side.halfEdge % 3] == lower; };
    for (size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
      while (end < entries.size() && entries[end].higherVertex == entries[begin].higherVertex) ++end;
      size_t out = begin, in = begin;  // The next half-edge of each direction.
      for (;; ++out, ++in) {
        while (out < end && !leaves(entries[out])) ++out;
        while (in < end && leaves(entries[in])) ++in;
        if (out >= end || in >= end) break;
        opposite[entries[out].halfEdge] = entries[in].halfEdge;
        opposite[entries[in].halfEdge] = entries[out].halfEdge;
      }
    }
  });
  return opposite;
}

}  // namespace asdfvk
