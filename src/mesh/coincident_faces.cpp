#include "mesh/coincident_faces.h"

#include <algorithm>
#include <bit>

#include "core/parallel.h"

namespace asdfvk {
namespace {

/// A vertex and a hash that distinguishes nearly all points of a bucket.
struct Fingerprint {
  uint32_t hash;
  uint32_t vertex;
  auto operator<=>(const Fingerprint&) const = default;
};

/// A face in the bucket of its lowest vertex. otherVertices: its other two vertices, in the order of the winding.
struct FaceKey {
  uint64_t otherVertices = 0;
  uint32_t face = 0;
  auto operator<=>(const FaceKey&) const = default;
};

/// Replaces each vertex of a face by the lowest vertex at the same point, and returns the least of the three rotations.
/// A face with two corners at one point keeps its own vertices. No ray hits such a face, because its area is 0.
Face placeOf(const Face& face, std::span<const uint32_t> lowestVertices) {
  Face place{lowestVertices[face[0]], lowestVertices[face[1]], lowestVertices[face[2]]};
  if (!hasDistinctVertices(place)) place = face;
  const auto& [a, b, c] = place;
  return std::min({place, Face{b, c, a}, Face{c, a, b}});
}

UnsetVector<uint32_t> lowestAmong(const TriangleMesh& mesh, std::span<const uint32_t> lowestVertices) {
  const Buckets<FaceKey> byLowestVertex =
      sortIntoBuckets<FaceKey>(mesh.vertices.size(), mesh.faces.size(), [&](uint32_t f, auto&& put) {
        const auto [a, b, c] = placeOf(mesh.faces[f], lowestVertices);
        put(a, FaceKey{uint64_t{b} << 32 | c, f});
      });
  UnsetVector<uint32_t> representatives(mesh.faces.size());
  forEachInParallel(byLowestVertex.bucketCount(), [&](uint32_t vertex) {
    const FaceKey* first = nullptr;
    for (const FaceKey& key : byLowestVertex[vertex]) {
      if (!first || first->otherVertices != key.otherVertices) first = &key;
      representatives[key.face] = first->face;
    }
  });
  return representatives;
}

/// Whether two faces have the same vertices. In a closed mesh, two such faces are the only faces at their three edges.
bool hasCopyByVertices(const DualGraph& closedGraph) {
  return countInParallel(closedGraph.faceCount(), [&](uint32_t f) {
           const std::span<const uint32_t> around = closedGraph.neighboursOf(f);
           return around.front() == around.back();
         }) > 0;
}

}  // namespace

UnsetVector<uint32_t> coincidentVertices(std::span<const Vec3d> vertices, bool joinsInfinite) {
  UnsetVector<uint32_t> lowest(vertices.size());
  forEachInParallel(lowest.size(), [&](uint32_t vertex) { lowest[vertex] = vertex; });
  const size_t bucketCount = std::bit_ceil(vertices.size() / 8 + 1);
  const StagedEntries<Fingerprint> points(bucketCount, vertices.size(), [&](uint32_t vertex, auto&& put) {
    const Vec3d& point = vertices[vertex];
    if (!isFinite(point) && !(joinsInfinite && point == point)) return;  // A NaN does not equal itself.
    const uint64_t hash = hashOf(point + Vec3d{});                       // -0 becomes 0.
    put(static_cast<uint32_t>(hash & (bucketCount - 1)), Fingerprint{static_cast<uint32_t>(hash >> 32), vertex});
  });
  points.forEachBucket([&](uint32_t, std::span<const Fingerprint> bucket) {
    size_t first = 0;  // First of the entries with the same hash.
    for (size_t i = 1; i < bucket.size(); ++i) {
      if (bucket[i].hash != bucket[first].hash) first = i;
      // `same` is nearly always `first`; different points may have the same hash.
      size_t same = first;
      while (same < i && !(vertices[bucket[same].vertex] == vertices[bucket[i].vertex])) ++same;
      lowest[bucket[i].vertex] = bucket[same].vertex;
    }
  });
  return lowest;
}

UnsetVector<uint32_t> coincidentRepresentatives(const TriangleMesh& mesh, const EdgeSurvey& edges) {
  const UnsetVector<uint32_t> lowestVertices = coincidentVertices(mesh.vertices);
  const auto isCopy = [&](uint32_t vertex) { return lowestVertices[vertex] != vertex; };
  if (!edges.isManifold || hasCopyByVertices(edges.graph) || countInParallel(lowestVertices.size(), isCopy) > 0)
    return lowestAmong(mesh, lowestVertices);
  UnsetVector<uint32_t> representatives(mesh.faces.size());
  forEachInParallel(representatives.size(), [&](uint32_t f) { representatives[f] = f; });
  return representatives;
}

Buckets<uint32_t> groupCopies(std::span<const uint32_t> representatives) {
  return sortIntoBuckets<uint32_t>(representatives.size(), representatives.size(),
                                   [&](uint32_t face, auto&& put) { put(representatives[face], face); });
}

}  // namespace asdfvk
