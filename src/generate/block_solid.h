#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// How the surface of a BlockSolid is cut into triangles. The surface, a set of points, does not depend on it.
struct SurfaceDivision {
  /// Blocks are divided until their edges are at most this long; the diagonals of the quads may be longer. Infinite:
  /// each block remains whole, which gives the coarsest mesh.
  double longestEdge = std::numeric_limits<double>::infinity();
  uint64_t diagonalSeed = 1;    ///< Each quad is cut at one of its two diagonals, by chance.
  bool otherDiagonals = false;  ///< Each quad is cut at the other diagonal than without.
};

/// A solid of hexahedra ("blocks") that meet at whole sides. A side that belongs to one block only is part of the
/// surface. Precondition: such sides are planar and convex.
class BlockSolid {
 public:
  /// Adds the blocks of a lattice. Its points are at `position`(i, j, k), from (0, 0, 0) to the three cell counts;
  /// cells are left out where `isFilled` is given and false. Equal positions are one corner of the solid: a lattice can
  /// close to a ring, continue an earlier one, or collapse sides of its blocks to an edge or a point. It may be
  /// mirrored.
  void addLattice(const std::array<uint32_t, 3>& cellCounts,
                  const std::function<Vec3d(uint32_t i, uint32_t j, uint32_t k)>& position,
                  const std::function<bool(uint32_t i, uint32_t j, uint32_t k)>& isFilled = {});

  /// Closed and oriented outwards, with one vertex per position.
  [[nodiscard]] Mesh surface(const SurfaceDivision& division = {}) const;

 private:
  using Block = std::array<uint32_t, 8>;  // Corner number i + 2 j + 4 k is at (i, j, k).

  uint32_t cornerAt(const Vec3d& position);
  void addBlock(Block block);
  [[nodiscard]] std::vector<std::array<uint32_t, 3>> divide(double longestEdge) const;

  std::vector<Vec3d> corners_;
  std::map<std::array<double, 3>, uint32_t> cornerOf_;
  std::vector<Block> blocks_;
};

/// A plane x = offset + slope * z, or y likewise: a wall with draft. The draft angle is atan(slope).
struct DraftedPlane {
  double offset = 0, slope = 0;

  [[nodiscard]] double at(double z) const { return offset + slope * z; }
};

/// A lattice between planes, in ascending order: those of the walls and horizontal ones.
void addDraftedLattice(BlockSolid& solid, const std::vector<DraftedPlane>& xs, const std::vector<DraftedPlane>& ys,
                       const std::vector<double>& zs,
                       const std::function<bool(uint32_t i, uint32_t j, uint32_t k)>& isFilled = {});

}  // namespace asdfvk
