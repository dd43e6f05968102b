#include "trace/crossed_faces.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "bvh/leaf_faces.h"
#include "core/box3.h"
#include "core/parallel.h"
#include "trace/chunks.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstChunkSize = 16384, kGrain = 256;

bool shareEdge(const PlaneTriangle& a, const PlaneTriangle& b) {
  return std::count_if(a.corners.begin(), a.corners.end(), [&](const Vec3d& corner) {
           return std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end();
         }) > 1;
}

/// Whether an edge of the first triangle passes through the second one.
bool crosses(const PlaneTriangle& edges, const PlaneTriangle& triangle, double minDepth) {
  std::array<double, 3> heights;
  for (size_t k = 0; k < 3; ++k) heights[k] = dot(edges.corners[k] - triangle.corners[0], triangle.normal);
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    if (std::min(heights[k], heights[next]) > -minDepth || std::max(heights[k], heights[next]) < minDepth) continue;
    const double t = heights[k] / (heights[k] - heights[next]);
    const Vec3d p = edges.corners[k] + t * (edges.corners[next] - edges.corners[k]);
    bool isInside = true;
    for (size_t i = 0; i < 3; ++i) {
      const Vec3d &a = triangle.corners[i], edge = triangle.corners[(i + 1) % 3] - a;
      isInside = isInside && dot(cross(edge, p - a), triangle.normal) > minDepth * length(edge);
    }
    if (isInside) return true;
  }
  return false;
}

}  // namespace

std::vector<uint8_t> findCrossedFaces(const TraceScene& scene, std::span<const uint32_t> solidOf, double minDepth,
                                      const RunControl& control) {
  std::vector<uint8_t> crossed(scene.mesh.faceCount());
  const std::span<const uint32_t> faces = scene.bvh.primitiveFaces;
  const auto mark = [&](uint32_t face, uint8_t bit) {
    std::atomic_ref(crossed[face]).fetch_or(bit, std::memory_order_relaxed);
  };
  forEachChunk(faces.size(), ChunkSize(kFirstChunkSize, faces.size()), control, [&](size_t begin, size_t end) {
    forEachRange(end - begin, kGrain, [&](size_t first, size_t last) {
      for (size_t i = begin + first; i < begin + last; ++i) {
        const uint32_t face = faces[i];
        const PlaneTriangle triangle = triangleOf(scene, face);
        Box3f box;
        for (const Vec3d& corner : triangle.corners) box.add(Vec3f(corner));
        const auto reaches = [&](const BvhNode& node) { return overlaps(node, box); };
        forEachLeafFace(scene.bvh, reaches, [&](uint32_t other) {
          if (other <= face) return true;
          const PlaneTriangle second = triangleOf(scene, other);
          if (shareEdge(triangle, second)) return true;
          if (!crosses(triangle, second, minDepth) && !crosses(second, triangle, minDepth)) return true;
          const uint8_t bit = solidOf[face] == solidOf[other] ? kCrossedBySame : kCrossedByOther;
          mark(face, bit);
          mark(other, bit);
          return true;
        });
      }
    });
  });
  return crossed;
}

}  // namespace asdfvk
