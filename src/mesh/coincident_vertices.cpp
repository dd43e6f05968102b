#include "mesh/coincident_vertices.h"

#include <bit>

#include "mesh/buckets.h"
#include "mesh/point_hash.h"

namespace asdfvk {
namespace {

struct Point {
  Vec3d position;
  uint32_t vertex = 0;

  bool operator<(const Point& other) const {
    for (size_t axis = 0; axis < 3; ++axis)
      if (position[axis] != other.position[axis]) return position[axis] < other.position[axis];
    return vertex < other.vertex;
  }
};

}  // namespace

std::vector<uint32_t> coincidentVertices(const Mesh& mesh) {
  // Few enough that their counts stay in a cache, else each vertex costs two misses.
  const size_t bucketCount = std::bit_ceil(mesh.vertices.size() / 32 + 1);
  const Buckets<Point> buckets =
      sortIntoBuckets<Point>(bucketCount, mesh.vertices.size(), [&](uint32_t vertex, auto&& put) {
        if (!isFinite(mesh.vertices[vertex])) return;
        const Vec3d position = mesh.vertices[vertex] + Vec3d{};  // -0 becomes 0.
        put(static_cast<uint32_t>(hashOf(position) & (bucketCount - 1)), Point{position, vertex});
      });
  std::vector<uint32_t> lowest(mesh.vertices.size());
  forEachInParallel(lowest.size(), [&](uint32_t vertex) { lowest[vertex] = vertex; });
  forEachInParallel(buckets.bucketCount(), [&](uint32_t bucket) {
    const Point* first = nullptr;
    for (const Point& point : buckets[bucket]) {
      if (!first || !(first->position == point.position)) first = &point;
      lowest[point.vertex] = first->vertex;
    }
  });
  return lowest;
}

}  // namespace asdfvk
