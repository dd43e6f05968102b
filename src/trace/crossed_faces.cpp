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
// Number of neighbouring faces for which the hierarchy is traversed together.
constexpr size_t kWalkFaceCount = 16;

struct BoxedFace {
  uint32_t face = 0;
  Box3f box;
};

bool overlap(const Box3f& a, const Box3f& b) {
  // Branch-free, because it is unpredictable which axis separates two boxes.
  return ((a.min.x <= b.max.x) & (a.min.y <= b.max.y) & (a.min.z <= b.max.z) & (b.min.x <= a.max.x) &
          (b.min.y <= a.max.y) & (b.min.z <= a.max.z)) != 0;
}

bool shareEdge(const PlaneTriangle& a, const PlaneTriangle& b) {
  return std::count_if(a.corners.begin(), a.corners.end(), [&](const Vec3d& corner) {
           return std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end();
         }) > 1;
}

/// Whether an edge of the first triangle passes through the second triangle.
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
  const auto markIfCrossed = [&](uint32_t face, uint32_t other) {
    const PlaneTriangle triangle = triangleOf(scene, face), second = triangleOf(scene, other);
    if (shareEdge(triangle, second)) return;
    if (!crosses(triangle, second, minDepth) && !crosses(second, triangle, minDepth)) return;
    const uint8_t bit = solidOf[face] == solidOf[other] ? kCrossedBySame : kCrossedByOther;
    mark(face, bit);
    mark(other, bit);
  };
  const auto boxed = [&](uint32_t face) {
    BoxedFace result{.face = face};
    for (const Vec3d& corner : triangleOf(scene, face).corners) result.box.add(Vec3f(corner));
    return result;
  };
  forEachChunk(faces.size(), ChunkSize(kFirstChunkSize, faces.size()), control, [&](size_t begin, size_t end) {
    forEachRange(end - begin, kGrain, [&](size_t first, size_t last) {
      std::vector<BoxedFace> block, near;
      for (size_t i = begin + first; i < begin + last; i += kWalkFaceCount) {
        block.clear();
        near.clear();
        Box3f box;
        for (const uint32_t face : faces.subspan(i, std::min(kWalkFaceCount, begin + last - i)))
          box.add(block.emplace_back(boxed(face)).box);
        const auto reaches = [&](const BvhNode& node) { return overlaps(node, box); };
        forEachLeafFace(scene.bvh, reaches, [&](uint32_t face) {
          near.push_back(boxed(face));
          return true;
        });
        for (const BoxedFace& one : block)
          for (const BoxedFace& other : near)
            if (other.face > one.face && overlap(one.box, other.box)) markIfCrossed(one.face, other.face);
      }
    });
  });
  return crossed;
}

}  // namespace asdfvk
