#include "predict/seed_cells.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"
#include "core/prefetch.h"
#include "shared/cone_hit.h"

namespace asdfvk {
namespace {

// A cell with this bit may still be replaced by a lower cell at the same distance.
constexpr uint32_t kClaimed = uint32_t{1} << 31;

/// Claims a face for `cell`. Has no effect if the face is assigned, or if a lower cell has claimed it. Returns whether
/// the face was unclaimed.
bool claim(uint32_t& cellOfFace, uint32_t cell) {
  const std::atomic_ref<uint32_t> atomic(cellOfFace);
  uint32_t seen = atomic.load(std::memory_order_relaxed);
  while ((seen & kClaimed) != 0 && (cell | kClaimed) < seen)
    if (atomic.compare_exchange_weak(seen, cell | kClaimed, std::memory_order_relaxed)) return seen == kNoCell;
  return false;
}

/// Breadth-first search. All faces at one distance from the seeds are processed in parallel.
UnsetVector<uint32_t> floodFromSeeds(const DualGraph& graph, std::span<const uint32_t> seeds) {
  ASDFVK_CHECK_OP(seeds.size(), <, size_t{kClaimed} - 1);
  UnsetVector<uint32_t> cellOf = filledInParallel(graph.faceCount(), kNoCell);
  std::vector<uint32_t> front;
  for (uint32_t cell = 0; cell < seeds.size(); ++cell) {
    if (seeds[cell] == kNoFace) continue;
    cellOf[seeds[cell]] = cell;
    front.push_back(seeds[cell]);
  }
  PerThread<std::vector<uint32_t>> claimed;
  while (!front.empty()) {
    constexpr size_t kGrain = 1024, kDistance = 8;  // Neighbours are prefetched 8 faces ahead, offsets 16 faces.
    forEachRange(front.size(), kGrain, [&](size_t begin, size_t end) {
      std::vector<uint32_t>& own = claimed.local();
      for (size_t i = begin; i < end; ++i) {
        if (i + 2 * kDistance < end) prefetchMemory(&graph.offsets[front[i + 2 * kDistance]]);
        if (i + kDistance < end) prefetchMemory(graph.neighbours.data() + graph.offsets[front[i + kDistance]]);
        for (const uint32_t neighbour : graph.neighboursOf(front[i]))
          if (claim(cellOf[neighbour], cellOf[front[i]])) own.push_back(neighbour);
      }
    });
    front.clear();
    claimed.forEach([&](std::vector<uint32_t>& own) {
      front.insert(front.end(), own.begin(), own.end());
      own.clear();
    });
    forEachInParallel(front.size(), [&](size_t i) { cellOf[front[i]] &= ~kClaimed; });
  }
  return cellOf;
}

}  // namespace

SeedCells buildSeedCells(const DualGraph& graph, std::span<const uint32_t> seeds) {
  SeedCells cells;
  cells.cellOf = floodFromSeeds(graph, seeds);
  const std::span<const uint32_t> cellOf = cells.cellOf;
  cells.faces = sortIntoBuckets<uint32_t>(seeds.size(), graph.faceCount(), [&](uint32_t face, const auto& put) {
    if (cellOf[face] != kNoCell) put(cellOf[face], face);
  });
  return cells;
}

/// Finds the row of one cell after another, each cell once.
class NearestCells::RowBuilder {
 public:
  RowBuilder(const DualGraph& graph, std::span<const uint32_t> cellOf, size_t cellCount, size_t stride)
      : graph_(graph), cellOf_(cellOf), stride_(stride), lastTouchedBy_(cellCount, kNoCell) {}

  /// centreOf: the barycentre of the seed of a cell. row: stride_ entries, all kNoCell.
  template <typename CentreOf>
  void build(uint32_t cell, std::span<const uint32_t> faces, const CentreOf& centreOf, uint32_t* row) {
    lastTouchedBy_[cell] = cell;
    touching_.clear();
    for (const uint32_t face : faces) {
      const std::span<const uint32_t> neighbours = graph_.neighboursOf(face);
      size_t count = touching_.size();
      touching_.resize(count + neighbours.size());
      for (const uint32_t neighbour : neighbours) {  // No branch: the processor cannot predict whether a cell is new.
        const uint32_t other = touching_[count] = cellOf_[neighbour];
        count += std::exchange(lastTouchedBy_[other], cell) != cell ? 1 : 0;
      }
      touching_.resize(count);
    }
    byDistance_.clear();
    const Vec3d centre = centreOf(cell);
    for (const uint32_t other : touching_) byDistance_.emplace_back(comparableSquare(centreOf(other) - centre), other);
    std::sort(byDistance_.begin(), byDistance_.end());
    if (byDistance_.size() > stride_ - 1) byDistance_.resize(stride_ - 1);
    *row++ = cell;
    for (const auto& [distance, other] : byDistance_) *row++ = other;
  }

 private:
  const DualGraph& graph_;
  std::span<const uint32_t> cellOf_;
  size_t stride_;
  std::vector<uint32_t> lastTouchedBy_;  // For each cell, the last built cell that equals or touches it.
  UnsetVector<uint32_t> touching_;
  std::vector<std::pair<double, uint32_t>> byDistance_;
};

NearestCells::NearestCells(const SeedCells& cells, const DualGraph& graph, const FaceGeometry& geometry,
                           std::span<const uint32_t> seeds, size_t neighbourCount)
    : stride_(1 + neighbourCount), nearest_(filledInParallel(seeds.size() * stride_, kNoCell)) {
  UnsetVector<Vec3d> centres(seeds.size());  // A copy, because these barycentres are far from each other in memory.
  forEachInParallel(seeds.size(), [&](size_t cell) {
    if (seeds[cell] != kNoFace) centres[cell] = geometry.barycentres[seeds[cell]];
  });
  PerThread<RowBuilder> builders([&] { return RowBuilder(graph, cells.cellOf, seeds.size(), stride_); });
  constexpr size_t kGrain = 256;
  forEachRange(seeds.size(), kGrain, [&](size_t begin, size_t end) {
    RowBuilder& rows = builders.local();
    for (auto cell = static_cast<uint32_t>(begin); cell < end; ++cell)
      if (seeds[cell] != kNoFace)
        rows.build(
            cell, cells.faces[cell], [&](uint32_t other) { return centres[other]; }, &nearest_[cell * stride_]);
  });
}

void NearestCells::update(std::span<const uint32_t> changed, const Buckets<uint32_t>& cells,
                          std::span<const uint32_t> cellOf, const DualGraph& graph, const FaceGeometry& geometry,
                          std::span<const uint32_t> seeds) {
  nearest_.resize(seeds.size() * stride_, kNoCell);
  PerThread<RowBuilder> builders([&] { return RowBuilder(graph, cellOf, seeds.size(), stride_); });
  constexpr size_t kGrain = 64;
  forEachRange(changed.size(), kGrain, [&](size_t begin, size_t end) {
    RowBuilder& rows = builders.local();
    for (size_t i = begin; i < end; ++i) {
      const uint32_t cell = changed[i];
      const std::span<uint32_t> row = std::span(nearest_).subspan(cell * stride_, stride_);
      std::ranges::fill(row, kNoCell);
      rows.build(
          cell, cells[cell], [&](uint32_t other) { return geometry.barycentres[seeds[other]]; }, row.data());
    }
  });
}

std::span<const uint32_t> NearestCells::of(uint32_t cell) const {
  const std::span<const uint32_t> row = std::span(nearest_).subspan(cell * stride_, stride_);
  return row.first(static_cast<size_t>(std::find(row.begin(), row.end(), kNoCell) - row.begin()));
}

}  // namespace asdfvk
