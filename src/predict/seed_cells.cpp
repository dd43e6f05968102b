#include "predict/seed_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "shared/cone_hit.h"

namespace asdfvk {
namespace {

std::vector<uint32_t> floodFromSeeds(const DualGraph& graph, std::span<const uint32_t> seeds) {
  std::vector<uint32_t> cellOf(graph.faceCount(), kNoCell);
  std::vector<uint32_t> queue;
  queue.reserve(graph.faceCount());
  for (uint32_t cell = 0; cell < seeds.size(); ++cell) {
    if (seeds[cell] == kNoFace) continue;
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
  return cells;
}

NearestCells::NearestCells(const SeedCells& cells, const DualGraph& graph, const FaceGeometry& geometry,
                           std::span<const uint32_t> seeds, size_t neighbourCount)
    : stride_(1 + neighbourCount), nearest_(seeds.size() * stride_, kNoCell) {
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, static_cast<uint32_t>(seeds.size()), 256), [&](const auto& range) {
    std::vector<uint32_t> touching;
    std::vector<std::pair<double, uint32_t>> byDistance;
    for (uint32_t cell = range.begin(); cell < range.end(); ++cell) {
      if (seeds[cell] == kNoFace) continue;
      touching.clear();
      for (const uint32_t face : cells.faces[cell])
        for (const uint32_t neighbour : graph.neighboursOf(face))
          if (cells.cellOf[neighbour] != cell) touching.push_back(cells.cellOf[neighbour]);
      std::sort(touching.begin(), touching.end());
      touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
      byDistance.clear();
      const Vec3d& centre = geometry.barycentres[seeds[cell]];
      for (const uint32_t other : touching) {
        const Vec3d between = geometry.barycentres[seeds[other]] - centre;
        byDistance.emplace_back(dot(between, between), other);
      }
      std::sort(byDistance.begin(), byDistance.end());
      if (byDistance.size() > stride_ - 1) byDistance.resize(stride_ - 1);
      auto nearest = nearest_.begin() + static_cast<std::ptrdiff_t>(cell * stride_);
      *nearest++ = cell;
      for (const auto& [distance, other] : byDistance) *nearest++ = other;
    }
  });
}

std::span<const uint32_t> NearestCells::of(uint32_t cell) const {
  const std::span<const uint32_t> row = std::span(nearest_).subspan(cell * stride_, stride_);
  return row.first(static_cast<size_t>(std::find(row.begin(), row.end(), kNoCell) - row.begin()));
}

}  // namespace asdfvk
