#include "mesh/dual_graph.h"

#include <utility>

#include "mesh/edges.h"

namespace asdfvk {

DualGraph buildDualGraph(const Mesh& mesh) {
  const EdgeTable edges = EdgeTable::build(mesh, [&](uint32_t f) { return mesh.hasFiniteCorners(f); });
  Buckets<uint32_t> rows =
      sortIntoBuckets<uint32_t>(mesh.faces.size(), edges.vertexCount(), [&](uint32_t vertex, auto&& put) {
        edges.forEachEdgeFrom(vertex, [&](uint32_t, std::span<const EdgeEntry> around) {
          const size_t reach = around.size() <= kMaxFacesJoinedAllToAll ? around.size() : 1;
          for (size_t i = 0; i < around.size(); ++i) {
            for (size_t j = i + 1; j < around.size() && j <= i + reach; ++j) {
              put(around[i].face(), around[j].face());
              put(around[j].face(), around[i].face());
            }
          }
        });
      });
  return {std::move(rows.offsets), std::move(rows.entries)};
}

}  // namespace asdfvk
