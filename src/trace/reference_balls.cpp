#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "trace/ball_shrinker.h"
#include "trace/chunks.h"
#include "trace/seed_order.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstChunkFaceCount = 4096;
// Neighbours that are answered one after the other.
constexpr size_t kBlockFaceCount = 256;

class ReferenceBallShrinker final : public BallShrinker {
 public:
  ReferenceBallShrinker(const TraceScene& scene, const OpposingWalls& walls)
      : order_(scene), tree_(scene, walls) {}

  uint64_t shrink(std::span<FaceBalls> faces, const RunControl& control) override {
    std::vector<uint32_t> indices(faces.size());
    std::transform(faces.begin(), faces.end(), indices.begin(), [](const FaceBalls& balls) { return balls.face; });
    const std::vector<uint32_t> order = order_.of(indices);
    forEachChunk(faces.size(), ChunkSize(kFirstChunkFaceCount, faces.size()), control, [&](size_t begin, size_t end) {
      const std::span<const uint32_t> chunk = std::span(order).subspan(begin, end - begin);
      forEachTask((chunk.size() + kBlockFaceCount - 1) / kBlockFaceCount, [&](size_t block) {
        const size_t first = block * kBlockFaceCount;
        shrinkBlock(faces, chunk.subspan(first, std::min(kBlockFaceCount, chunk.size() - first)));
      });
    });
    return 0;
  }

 private:
  void shrinkBlock(std::span<FaceBalls> faces, std::span<const uint32_t> block) const {
    std::vector<BallQuery> queries(block.size());
    for (size_t i = 0; i < block.size(); ++i) {
      const FaceBalls& balls = faces[block[i]];
      queries[i] = {triangleOf(tree_.scene(), balls.face), tree_.scene().originOf(balls.face), balls.atBarycentre,
                    balls.least};
    }
    tree_.shrink(queries);
    for (size_t i = 0; i < block.size(); ++i) {
      FaceBalls& balls = faces[block[i]];
      balls.atBarycentre = queries[i].atPoint;
      balls.least = queries[i].least;
    }
  }

  SeedOrder order_;
  WallTree tree_;
};

}  // namespace

std::unique_ptr<BallShrinker> makeReferenceBallShrinker(const TraceScene& scene, const OpposingWalls& walls) {
  return std::make_unique<ReferenceBallShrinker>(scene, walls);
}

}  // namespace asdfvk
