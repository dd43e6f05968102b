#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/unset_vector.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// The faces that a computation is about, as nodes of a graph: all faces of a mesh, a region, or the centres of
/// aggregates. The nodes have indices of their own, 0 to #N - 1, in the order of their faces. Views only.
struct FaceDomain {
  const DualGraph& graph;                            ///< #N nodes.
  const FaceGeometry& geometry;                      ///< #N: geometry of the face of each node.
  std::span<const uint32_t> componentOf;             ///< #N: component in `graph`.
  size_t componentCount = 0;                         ///< Components may be without a node.
  std::span<const uint32_t> traceable;               ///< Nodes that can cast rays, ascending.
  std::span<const uint32_t> faces = {};              ///< #N: the face of each node, ascending; empty: node i is face i.
  std::span<const uint32_t> representedCounts = {};  ///< #N: number of faces that the node stands for; empty: 1 each.

  [[nodiscard]] uint32_t size() const { return graph.faceCount(); }
  [[nodiscard]] uint32_t faceOf(uint32_t node) const { return faces.empty() ? node : faces[node]; }
  [[nodiscard]] uint32_t representedCountOf(uint32_t node) const {
    return representedCounts.empty() ? 1 : representedCounts[node];
  }
};

/// #N from #F.
template <typename T>
[[nodiscard]] std::vector<T> atNodes(const FaceDomain& domain, std::vector<T> ofFaces) {
  return domain.faces.empty() ? std::move(ofFaces) : entriesAt<std::vector<T>>(domain.faces, ofFaces);
}

/// #F from #N. Faces without a node get `other`.
template <typename Entries>
[[nodiscard]] Entries atFaces(const FaceDomain& domain, Entries ofNodes, size_t faceCount,
                              const typename Entries::value_type& other) {
  if (domain.faces.empty()) return ofNodes;
  Entries ofFaces(faceCount);
  forEachRange(faceCount, kItemsPerTask,
               [&](size_t begin, size_t end) { std::fill(ofFaces.data() + begin, ofFaces.data() + end, other); });
  forEachInParallel(ofNodes.size(), [&](size_t node) { ofFaces[domain.faces[node]] = ofNodes[node]; });
  return ofFaces;
}

/// The faces of some nodes.
[[nodiscard]] inline std::vector<uint32_t> facesAt(const FaceDomain& domain, std::span<const uint32_t> nodes) {
  return domain.faces.empty() ? std::vector<uint32_t>(nodes.begin(), nodes.end())
                              : entriesAt<std::vector<uint32_t>>(nodes, domain.faces);
}

/// The geometry of some faces, with the bounds of the whole mesh.
[[nodiscard]] FaceGeometry geometryOf(const FaceGeometry& geometry, std::span<const uint32_t> faces);

}  // namespace asdfvk
