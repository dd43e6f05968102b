#include "trace/face_balls.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "trace/chunks.h"
#include "trace/seed_order.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstChunkFaceCount = 4096;
// Neighbours that are answered one after the other.
constexpr size_t kBlockFaceCount = 256;

void shrinkBlock(const WallTree& tree, std::span<FaceBalls> faces, std::span<const uint32_t> block) {
  std::vector<BallQuery> queries(block.size());
  for (size_t i = 0; i < block.size(); ++i) {
    const FaceBalls& balls = faces[block[i]];
    queries[i] = {triangleOf(tree.scene(), balls.face), tree.scene().originOf(balls.face), balls.atBarycentre,
                  balls.least};
  }
  tree.shrink(queries);
  for (size_t i = 0; i < block.size(); ++i) {
    faces[block[i]].atBarycentre = queries[i].atPoint;
    faces[block[i]].least = queries[i].least;
  }
}

}  // namespace

void shrinkFaceBalls(const WallTree& tree, std::span<FaceBalls> faces, const RunControl& control) {
  std::vector<uint32_t> indices(faces.size());
  std::transform(faces.begin(), faces.end(), indices.begin(), [](const FaceBalls& balls) { return balls.face; });
  const std::vector<uint32_t> order = SeedOrder(tree.scene()).of(indices);
  forEachChunk(faces.size(), ChunkSize(kFirstChunkFaceCount, faces.size()), control, [&](size_t begin, size_t end) {
    const std::span<const uint32_t> chunk = std::span(order).subspan(begin, end - begin);
    forEachTask((chunk.size() + kBlockFaceCount - 1) / kBlockFaceCount, [&](size_t block) {
      const size_t first = block * kBlockFaceCount;
      shrinkBlock(tree, faces, chunk.subspan(first, std::min(kBlockFaceCount, chunk.size() - first)));
    });
  });
}

}  // namespace asdfvk
