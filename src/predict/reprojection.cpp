#include "predict/reprojection.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "predict/cell_reprojection.h"

namespace asdfvk {
namespace {

// Cells predicted together: together they ask one and a half times as many seeds.
constexpr size_t kBlockSize = 128;

/// Neighbours in space side by side: in the order of their seeds in the hierarchy.
std::vector<uint32_t> cellsInOrder(const TraceScene& scene, std::span<const uint32_t> seeds, const SeedCells& cells) {
  std::vector<uint32_t> order;
  std::vector<uint8_t> isListed(seeds.size(), 0);
  order.reserve(seeds.size());
  for (const uint32_t face : scene.bvh.slotFaces) {
    const uint32_t cell = cells.cellOf[face];
    if (cell == kNoCell || seeds[cell] != face) continue;
    order.push_back(cell);
    isListed[cell] = 1;
  }
  // Copies of other faces are not in the hierarchy.
  for (uint32_t cell = 0; cell < seeds.size(); ++cell)
    if (seeds[cell] != kNoFace && !isListed[cell]) order.push_back(cell);
  return order;
}

}  // namespace

Prediction reprojectHits(const TraceScene& scene, const DualGraph& graph, const Cone& cone, const TracedCones& traced,
                         const ReprojectionOptions& options, Prediction earlier) {
  ASDFVK_CHECK_OP(traced.hits.size(), ==, traced.seeds.size() * cone.directions.size());
  SeedCells cells = buildSeedCells(graph, traced.seeds);
  Prediction prediction{std::vector<double>(scene.geometry.areas.size(), kNoValue),
                        {},
                        NearestCells(cells, graph, scene.geometry, traced.seeds, options.neighbourCount)};
  const ReprojectionTask task{scene, cone, traced, cells, prediction.nearest, options, earlier};
  const std::vector<uint32_t> order = cellsInOrder(scene, traced.seeds, cells);
  const size_t blockCount = (order.size() + kBlockSize - 1) / kBlockSize;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, blockCount), [&](const tbb::blocked_range<size_t>& range) {
    CellReprojection reprojection(task);
    for (size_t block = range.begin(); block < range.end(); ++block) {
      const size_t first = block * kBlockSize;
      reprojection.run(std::span(order).subspan(first, std::min(kBlockSize, order.size() - first)), prediction.values);
    }
  });
  prediction.cellOf = std::move(cells.cellOf);
  return prediction;
}

}  // namespace asdfvk
