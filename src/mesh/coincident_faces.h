#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "mesh/dual_graph.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A hash of the point's bits: the finalizer of SplitMix64 over each number in turn. -0 and 0 differ.
[[nodiscard]] inline uint64_t hashOf(const Vec3d& point) {
  uint64_t h = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    h = (h ^ std::bit_cast<uint64_t>(point[axis])) + 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return h;
}

/// #F: the representative of each face, the face of lowest index with its corners at the same three points in the same
/// winding. Vertex indices may differ. Points are the same where their coordinates are equal and finite; -0 equals 0.
/// Faces with two corners at one point are compared by vertex indices. Copies are treated as one face, so that every
/// backend reports the same one. Faces at the same points in the other winding, as where parts touch, are other faces.
/// edges: of the mesh; they often prove quickly that there are no copies.
[[nodiscard]] std::vector<uint32_t> coincidentRepresentatives(const TriangleMesh& mesh, const EdgeSurvey& edges);

/// The faces by their representatives.
class FaceCopies {
 public:
  explicit FaceCopies(std::span<const uint32_t> representatives);

  /// A representative and its copies, ascending.
  [[nodiscard]] std::span<const uint32_t> of(uint32_t representative) const {
    return std::span(faces_).subspan(first_[representative], first_[representative + 1] - first_[representative]);
  }

 private:
  std::vector<uint32_t> first_;  // #F + 1
  std::vector<uint32_t> faces_;  // #F
};

}  // namespace asdfvk
