#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/parallel.h"
#include "core/vec3.h"
#include "generate/capsule_union.h"

namespace asdfvk {

/// mask: which of the eight corners of a lattice cell are inside (bit i + 2 j + 4 k: corner (i, j, k)). A well-composed
/// mask has no two inside corners and no two outside corners that touch only across a diagonal of a side or of the
/// cell. Returns -1 for a well-composed mask. For other masks, returns an outside corner; adding it is a step towards a
/// well-composed mask.
[[nodiscard]] int32_t cornerToFill(uint32_t mask);

inline constexpr int32_t kBrickEdge = 8;
inline constexpr size_t kBricksPerTask = 16;

template <typename Body>
void forEachBrick(size_t count, const Body& body) {
  forEachRange(count, kBricksPerTask, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) body(i);
  });
}

/// Calls use(x, y, z) for the points of a brick, x fastest.
template <typename Use>
void forEachPoint(const Use& use) {
  for (int32_t z = 0; z < kBrickEdge; ++z)
    for (int32_t y = 0; y < kBrickEdge; ++y)
      for (int32_t x = 0; x < kBrickEdge; ++x) use(x, y, z);
}

/// 8^3 lattice points near the surface. Point (x, y, z) of the brick is bit x + 8 y of word z.
struct Brick {
  std::array<int32_t, 3> coordinates{};   ///< Coordinates of the lowest point of the brick, divided by kBrickEdge.
  CapsuleUnion::Selection selection = 0;  ///< The capsules that affect this brick.
  std::array<uint64_t, 8> inside{};
};

/// The signs of the corners of all cells whose lowest corner lies in a brick: 9^3 flags, x fastest.
class CellCorners {
 public:
  [[nodiscard]] bool& at(int32_t x, int32_t y, int32_t z) { return flags_[index(x, y, z)]; }
  [[nodiscard]] bool at(int32_t x, int32_t y, int32_t z) const { return flags_[index(x, y, z)]; }
  /// Bit i + 2 j + 4 k is corner (x + i, y + j, z + k) of the cell.
  [[nodiscard]] uint32_t mask(int32_t x, int32_t y, int32_t z) const;

 private:
  [[nodiscard]] static size_t index(int32_t x, int32_t y, int32_t z) {
    const int32_t flag = x + (kBrickEdge + 1) * (y + (kBrickEdge + 1) * z);
    return static_cast<size_t>(flag);
  }
  std::array<bool, (kBrickEdge + 1) * (kBrickEdge + 1) * (kBrickEdge + 1)> flags_{};
};

/// Calls use(axis, x, y, z, isInside) for the lattice edges that start at a point of the brick and cross the surface.
template <typename Use>
void forEachCrossedEdge(const CellCorners& signs, const Use& use) {
  forEachPoint([&](int32_t x, int32_t y, int32_t z) {
    const bool here = signs.at(x, y, z);
    if (here != signs.at(x + 1, y, z)) use(0, x, y, z, here);
    if (here != signs.at(x, y + 1, z)) use(1, x, y, z, here);
    if (here != signs.at(x, y, z + 1)) use(2, x, y, z, here);
  });
}

/// Points of a cubic lattice inside a shape. Bricks that the surface cannot reach (Lipschitz bound) are not stored.
///
/// The set of inside points is made well-composed (see cornerToFill(); Latecki, 1997). If and only if the set is
/// well-composed, the boundary of the voxels of its points is a closed 2-manifold. All radii are raised to at least
/// half the diagonal of a cell, so that parts thinner than a cell stay connected.
class BrickLattice {
 public:
  BrickLattice(const CapsuleUnion& field, double spacing);

  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] const std::vector<Brick>& bricks() const { return bricks_; }
  [[nodiscard]] Vec3d position(const Brick& brick, double x, double y, double z) const;
  [[nodiscard]] CellCorners corners(const Brick& brick) const;
  /// Index of the brick at these brick coordinates; -1 if the brick is not stored.
  [[nodiscard]] int64_t find(int32_t x, int32_t y, int32_t z) const;
  /// Number of lattice edges that the surface crosses, which is the number of quads of the surface.
  [[nodiscard]] uint64_t crossedEdgeCount() const;

 private:
  void refine();
  void evaluateSigns();
  void makeWellComposed();

  CapsuleUnion field_;
  double spacing_;
  Vec3d origin_;
  std::array<int32_t, 3> size_{};  ///< Number of bricks along each axis.
  std::vector<Brick> bricks_;
  std::unordered_map<uint64_t, uint32_t> brickAt_;
};

}  // namespace asdfvk
