#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/buckets.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

inline constexpr uint32_t kNoCell = std::numeric_limits<uint32_t>::max();

/// The faces that are nearest to each seed, counted in steps over the dual graph: its cell. Cells are told by their
/// seed's index.
struct SeedCells {
  std::vector<uint32_t> cellOf;  ///< #F; kNoCell where no path leads from a seed.
  Buckets<uint32_t> faces;       ///< #S: the faces of each cell, ascending, the seed among them.
};

/// Breadth first from all seeds at once; linear. seeds: face indices, each once; kNoFace leaves a cell empty.
[[nodiscard]] SeedCells buildSeedCells(const DualGraph& graph, std::span<const uint32_t> seeds);

/// Per cell: itself and up to `neighbourCount` of the cells that share an edge with it, those with the nearest seeds:
/// itself first, the others by the distance of their seed's barycentre from its own.
class NearestCells {
 public:
  NearestCells() = default;
  NearestCells(const SeedCells& cells, const DualGraph& graph, const FaceGeometry& geometry,
               std::span<const uint32_t> seeds, size_t neighbourCount);

  [[nodiscard]] std::span<const uint32_t> of(uint32_t cell) const;
  [[nodiscard]] size_t cellCount() const { return nearest_.size() / stride_; }

 private:
  size_t stride_ = 1;
  std::vector<uint32_t> nearest_;  // #S x stride, kNoCell where there are no more.
};

}  // namespace asdfvk
