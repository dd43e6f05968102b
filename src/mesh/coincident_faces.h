#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bucket_sort.h"
#include "core/unset_vector.h"
#include "core/vec3.h"
#include "mesh/dual_graph.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A hash of the bits of the coordinates, by the finalizer of SplitMix64. -0 and 0 have different hashes.
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

/// For each vertex the lowest vertex at exactly the same point; the vertex itself where there is no other. #V. -0
/// equals 0. A vertex with a NaN equals only itself, and so does one with an infinite coordinate unless joinsInfinite.
[[nodiscard]] UnsetVector<uint32_t> coincidentVertices(std::span<const Vec3d> vertices, bool joinsInfinite = false);

/// #F: the representative of each face, which is the face of lowest index with its corners at the same three points in
/// the same winding. Vertex indices may differ. Points are the same where their coordinates are equal and finite; -0
/// equals 0. Faces with two corners at one point are compared by vertex indices. A face whose representative is another
/// face is a copy. If a ray hits a copy, the hit is reported as a hit of the representative, so that every backend
/// reports the same face. Faces at the same points in opposite winding, for example where parts touch, are not copies.
/// edges: the survey of the mesh, which often proves quickly that there are no copies.
[[nodiscard]] UnsetVector<uint32_t> coincidentRepresentatives(const TriangleMesh& mesh, const EdgeSurvey& edges);

/// For each representative its own index and those of its copies; nothing for any other face.
[[nodiscard]] Buckets<uint32_t> groupCopies(std::span<const uint32_t> representatives);

}  // namespace asdfvk
