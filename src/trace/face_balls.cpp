#include "trace/face_balls.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "trace/adaptive_chunks.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstChunkFaceCount = 4096;
// Number of neighbouring faces per task.
constexpr size_t kBlockFaceCount = 256;

void shrinkBlock(const WallTree& tree, std::span<FaceBalls> faces) {
  std::vector<BallQuery> queries(faces.size());
  for (size_t i = 0; i < faces.size(); ++i)
    queries[i] = {triangleOf(tree.scene(), faces[i].face), tree.scene().originOf(faces[i].face), faces[i].atBarycentre,
                  faces[i].least, tree.bodyOf(faces[i].face)};
  tree.shrink(queries);
  for (size_t i = 0; i < faces.size(); ++i) {
    faces[i].atBarycentre = queries[i].atPoint;
    faces[i].least = queries[i].least;
  }
}

}  // namespace

void shrinkFaceBalls(const WallTree& tree, std::span<FaceBalls> faces, const RunControl& control) {
  forEachChunk(faces.size(), ChunkSize(kFirstChunkFaceCount, faces.size()), control, [&](size_t begin, size_t end) {
    const std::span<FaceBalls> chunk = faces.subspan(begin, end - begin);
    forEachTask((chunk.size() + kBlockFaceCount - 1) / kBlockFaceCount, [&](size_t block) {
      const size_t first = block * kBlockFaceCount;
      shrinkBlock(tree, chunk.subspan(first, std::min(kBlockFaceCount, chunk.size() - first)));
    });
  });
}

}  // namespace asdfvk
