#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/bucket_sort.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A face at an edge. Entries are ordered by their upper vertices, then by their corners. The members are in the
/// opposite order, so that the compiler loads a key as one number.
struct EdgeEntry {
  uint32_t corner;  ///< 3 f + i: the edge runs from corner i of face f to its next corner.
  uint32_t upperVertex;

  [[nodiscard]] uint32_t face() const { return corner / 3; }
  bool operator<(const EdgeEntry& other) const { return key() < other.key(); }

 private:
  [[nodiscard]] uint64_t key() const { return uint64_t{upperVertex} << 32 | corner; }
};

/// The faces around every edge, in buckets by the lower vertex of the edge. Memory: 36 bytes per face.
class EdgeTable {
 public:
  /// Faces for which takesPart(face) is false have no edges. An edge between a vertex and itself is ignored. A face
  /// that traverses an edge twice (a-b-a) is entered once. Precondition: every index of a face is below the vertex
  /// count.
  template <typename TakesPart>
  EdgeTable(const TriangleMesh& mesh, const TakesPart& takesPart)
      : entries_(mesh.vertices.size(), mesh.faces.size(), [&](uint32_t f, auto&& put) {
          if (!takesPart(f)) return;
          const auto [a, b, c] = mesh.faces[f];
          const auto putEdge = [&](uint32_t p, uint32_t q, uint32_t i) {
            if (p != q) put(std::min(p, q), EdgeEntry{3 * f + i, std::max(p, q)});
          };
          putEdge(a, b, 0);
          if (c != a) putEdge(b, c, 1);
          if (b != c && a != b) putEdge(c, a, 2);
        }) {}

  /// Calls visit(lowerVertex, entries) once for every edge, in parallel.
  template <typename Visit>
  void forEachEdge(const Visit& visit) const {
    entries_.forEachBucket([&](uint32_t lower, std::span<const EdgeEntry> bucket) {
      for (size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
        const uint32_t upper = bucket[begin].upperVertex;
        while (end < bucket.size() && bucket[end].upperVertex == upper) ++end;
        visit(lower, bucket.subspan(begin, end - begin));
      }
    });
  }

 private:
  StagedEntries<EdgeEntry> entries_;
};

}  // namespace asdfvk
