#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "core/bucket_sort.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

inline constexpr uint32_t kNoCell = std::numeric_limits<uint32_t>::max();

/// The squared length, rounded to 24 bits. Equal distances in regular meshes remain equal, so that neither rounding nor
/// the unit of the mesh decides their order.
[[nodiscard]] inline double comparableSquare(const Vec3d& between) {
  constexpr uint64_t kLast = uint64_t{1} << 29;  // The last of the 24 bits.
  const double square = dot(between, between);
  if (square < std::numeric_limits<double>::min()) return square;  // A subnormal number already has few bits.
  return std::bit_cast<double>((std::bit_cast<uint64_t>(square) + kLast / 2) & ~(kLast - 1));
}

/// Voronoi cells of the seeds on the dual graph: each face belongs to the seed that is the fewest steps away. A cell
/// has the index of its seed.
struct SeedCells {
  UnsetVector<uint32_t> cellOf;  ///< #F; kNoCell in a component without a seed.
  Buckets<uint32_t> faces;       ///< #S: the faces of each cell, ascending, including the seed.
};

/// Breadth-first search from all seeds at once; linear time. seeds: face indices, each once; kNoFace leaves a cell
/// empty.
[[nodiscard]] SeedCells buildSeedCells(const DualGraph& graph, std::span<const uint32_t> seeds);

/// For each cell, a row of cells. The row begins with the cell itself. At most neighbourCount of the cells that share
/// an edge with it follow, beginning with the nearest. Distances are between the barycentres of the seeds.
class NearestCells {
 public:
  NearestCells() = default;
  /// Memory: 4 bytes per cell and thread.
  NearestCells(const SeedCells& cells, const DualGraph& graph, const FaceGeometry& geometry,
               std::span<const uint32_t> seeds, size_t neighbourCount);

  /// Adds or replaces the rows of the changed cells. Needs as much memory as the constructor. changed: lists each cell
  /// once. cells: the faces of each changed cell. cellOf: #F, the cell of each face.
  void update(std::span<const uint32_t> changed, const Buckets<uint32_t>& cells, std::span<const uint32_t> cellOf,
              const DualGraph& graph, const FaceGeometry& geometry, std::span<const uint32_t> seeds);

  [[nodiscard]] std::span<const uint32_t> of(uint32_t cell) const;
  [[nodiscard]] size_t cellCount() const { return nearest_.size() / stride_; }

 private:
  class RowBuilder;

  size_t stride_ = 1;
  UnsetVector<uint32_t> nearest_;  // #S x stride, padded with kNoCell.
};

}  // namespace asdfvk
