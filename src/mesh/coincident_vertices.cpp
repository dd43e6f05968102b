#include "mesh/coincident_vertices.h"

#include <bit>

#include "core/buckets.h"
#include "mesh/point_hash.h"

namespace asdfvk {
namespace {

/// A vertex and a hash that distinguishes nearly all points of a bucket.
struct Fingerprint {
  uint32_t hash;
  uint32_t vertex;
  auto operator<=>(const Fingerprint&) const = default;
};

}  // namespace

std::vector<uint32_t> coincidentVertices(const TriangleMesh& mesh) {
  std::vector<uint32_t> lowest(mesh.vertices.size());
  forEachInParallel(lowest.size(), [&](uint32_t vertex) { lowest[vertex] = vertex; });
  const size_t bucketCount = std::bit_ceil(mesh.vertices.size() / 8 + 1);
  const StagedEntries<Fingerprint> points(bucketCount, mesh.vertices.size(), [&](uint32_t vertex, auto&& put) {
    if (!isFinite(mesh.vertices[vertex])) return;
    const uint64_t hash = hashOf(mesh.vertices[vertex] + Vec3d{});  // -0 becomes 0.
    put(static_cast<uint32_t>(hash & (bucketCount - 1)), Fingerprint{static_cast<uint32_t>(hash >> 32), vertex});
  });
  points.forEachBucket([&](uint32_t, std::span<const Fingerprint> bucket) {
    size_t first = 0;  // Of the entries with the same hash.
    for (size_t i = 1; i < bucket.size(); ++i) {
      if (bucket[i].hash != bucket[first].hash) first = i;
      // Nearly always the first; different points may have the same hash.
      size_t same = first;
      while (!(mesh.vertices[bucket[same].vertex] == mesh.vertices[bucket[i].vertex])) ++same;
      lowest[bucket[i].vertex] = bucket[same].vertex;
    }
  });
  return lowest;
}

}  // namespace asdfvk
