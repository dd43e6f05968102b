#include "reprojection/seed_cells.h"

#include <algorithm>
#include <utility>

namespace asdfvk {
namespace {

std::vector<uint32_t> floodFromSeeds(const DualGraph& graph, std::span<const uint32_t> seeds) {
  std::vector<uint32_t> cellOf(graph.faceCount(), kNoCell);
  std::vector<uint32_t> queue;
  queue.reserve(graph.faceCount());
  for (uint32_t cell = 0; cell < seeds.size(); ++cell) {
    cellOf[seeds[cell]] = cell;
    queue.push_back(seeds[cell]);
  }
  for (size_t next = 0; next < queue.size(); ++next)
    for (const uint32_t neighbour : graph.neighboursOf(queue[next])) {
      if (cellOf[neighbour] != kNoCell) continue;
      cellOf[neighbour] = cellOf[queue[next]];
      queue.push_back(neighbour);
    }
  return cellOf;
}

}  // namespace

SeedCells buildSeedCells(const DualGraph& graph, std::span<const uint32_t> seeds) {
  SeedCells cells;
  cells.cellOf = floodFromSeeds(graph, seeds);
  const std::vector<uint32_t>& cellOf = cells.cellOf;
  cells.faces = sortIntoBuckets<uint32_t>(seeds.size(), graph.faceCount(), [&](uint32_t face, const auto& put) {
    if (cellOf[face] != kNoCell) put(cellOf[face], face);
  });
  cells.neighbours =
      withoutRepeats(sortIntoBuckets<uint32_t>(seeds.size(), graph.faceCount(), [&](uint32_t face, const auto& put) {
        for (const uint32_t neighbour : graph.neighboursOf(face))
          if (cellOf[neighbour] != cellOf[face]) put(cellOf[face], cellOf[neighbour]);
      }));
  return cells;
}

std::vector<uint32_t> nearestCells(const SeedCells& cells, const FaceGeometry& geometry,
                                   std::span<const uint32_t> seeds, uint32_t cell, size_t neighbourCount) {
  const Vec3d& centre = geometry.barycentres[seeds[cell]];
  std::vector<std::pair<double, uint32_t>> byDistance;
  for (const uint32_t other : cells.neighbours[cell]) {
    const Vec3d between = geometry.barycentres[seeds[other]] - centre;
    byDistance.emplace_back(dot(between, between), other);
  }
  std::sort(byDistance.begin(), byDistance.end());
  if (byDistance.size() > neighbourCount) byDistance.resize(neighbourCount);
  std::vector<uint32_t> nearest{cell};
  for (const auto& [distance, other] : byDistance) nearest.push_back(other);
  return nearest;
}

}  // namespace asdfvk
