#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "mesh/buckets.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// One face at an edge. Entries order by the edge's other vertex, then by face.
struct EdgeEntry {
  uint64_t key = 0;

  EdgeEntry() = default;
  EdgeEntry(uint32_t upper, uint32_t faceIndex) : key(uint64_t{upper} << 32 | faceIndex) {}
  [[nodiscard]] uint32_t upperVertex() const { return static_cast<uint32_t>(key >> 32); }
  [[nodiscard]] uint32_t face() const { return static_cast<uint32_t>(key); }
  auto operator<=>(const EdgeEntry&) const = default;
};

/// The faces around every edge, bucketed by the edge's lower vertex. 24 B per face and 4 B per vertex.
class EdgeTable {
 public:
  /// Faces for which takesPart(face) is false have no edge; an edge between a vertex and itself is none. A face that
  /// runs along an edge twice, a-b-a, is there once. Precondition: every index of a face is below the vertex count.
  template <typename TakesPart>
  [[nodiscard]] static EdgeTable build(const Mesh& mesh, const TakesPart& takesPart) {
    EdgeTable table;
    table.entries_ = sortIntoBuckets<EdgeEntry>(mesh.vertices.size(), mesh.faces.size(), [&](uint32_t f, auto&& put) {
      if (!takesPart(f)) return;
      const auto [a, b, c] = mesh.faces[f];
      const auto putEdge = [&](uint32_t p, uint32_t q) {
        if (p != q) put(std::min(p, q), EdgeEntry(std::max(p, q), f));
      };
      putEdge(a, b);
      if (c != a) putEdge(b, c);
      if (b != c && a != b) putEdge(c, a);
    });
    return table;
  }

  [[nodiscard]] uint32_t vertexCount() const { return entries_.bucketCount(); }

  /// Calls visit(upperVertex, entries) for every edge from `lowerVertex` up; the entries ascend by face.
  template <typename Visit>
  void forEachEdgeFrom(uint32_t lowerVertex, const Visit& visit) const {
    const std::span<const EdgeEntry> bucket = entries_[lowerVertex];
    for (size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
      const uint32_t upper = bucket[begin].upperVertex();
      while (end < bucket.size() && bucket[end].upperVertex() == upper) ++end;
      visit(upper, bucket.subspan(begin, end - begin));
    }
  }

 private:
  Buckets<EdgeEntry> entries_;
};

}  // namespace asdfvk
