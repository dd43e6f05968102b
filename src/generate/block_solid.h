#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// Division of the surface of a BlockSolid into triangles. The shape of the surface does not depend on the division.
struct SurfaceDivision {
  /// Edges of blocks are divided into parts of at most this length; the diagonals of the quads may be longer. Infinite:
  /// the coarsest mesh.
  double longestEdge = std::numeric_limits<double>::infinity();
  uint64_t diagonalSeed = 1;    ///< Random seed for the diagonal at which each quad is cut.
  bool otherDiagonals = false;  ///< Cuts each quad at its other diagonal instead.
};

/// A solid of hexahedra ("blocks") that meet at whole sides. A side that belongs to one block only is part of the
/// surface. Precondition: sides of the surface are planar and convex.
class BlockSolid {
 public:
  /// Adds a block per cell of a lattice. Lattice point (i, j, k), from (0, 0, 0) to the three cell counts, is at
  /// position(i, j, k). Leaves out cells for which `isFilled` returns false. Equal positions become one corner.
  /// Therefore a lattice can close to a ring, continue another lattice, or have collapsed sides. A lattice can also be
  /// mirrored.
  void addLattice(const std::array<uint32_t, 3>& cellCounts,
                  const std::function<Vec3d(uint32_t i, uint32_t j, uint32_t k)>& position,
                  const std::function<bool(uint32_t i, uint32_t j, uint32_t k)>& isFilled = {});

  /// The surface: closed, oriented outwards, with one vertex per position.
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

/// A plane x = offset + slope * z or y = offset + slope * z: a wall with draft. The draft angle is atan(slope).
struct DraftedPlane {
  double offset = 0, slope = 0;

  [[nodiscard]] double at(double z) const { return offset + slope * z; }
};

/// Adds a lattice between drafted planes in x and y and horizontal planes at the heights zs. Each list ascends.
void addDraftedLattice(BlockSolid& solid, const std::vector<DraftedPlane>& xs, const std::vector<DraftedPlane>& ys,
                       const std::vector<double>& zs,
                       const std::function<bool(uint32_t i, uint32_t j, uint32_t k)>& isFilled = {});

}  // namespace asdfvk
