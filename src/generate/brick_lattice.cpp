#include "generate/brick_lattice.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>

#include "core/check.h"

namespace asdfvk {
namespace {

int8_t computeCornerToFill(uint32_t mask) {
  const auto lowest = [](uint32_t bits) { return static_cast<int8_t>(std::countr_zero(bits)); };
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    for (const uint32_t base : {0u, 1u << axis}) {
      const uint32_t side = 1u << base | 1u << (base + u) | 1u << (base + v) | 1u << (base + u + v);
      const uint32_t diagonal = 1u << base | 1u << (base + u + v);
      if ((mask & side) == diagonal) return lowest(side & ~diagonal);
      if ((mask & side) == (side & ~diagonal)) return lowest(diagonal);
    }
  }
  for (uint32_t corner = 0; corner < 4; ++corner) {
    const uint32_t diagonal = 1u << corner | 1u << (7 - corner);
    if (mask == diagonal) return static_cast<int8_t>(corner ^ 1u);
    if (mask == (0xffu & ~diagonal)) return static_cast<int8_t>(corner);
  }
  return -1;
}

std::array<int8_t, 256> computeTable() {
  std::array<int8_t, 256> table{};
  for (uint32_t mask = 0; mask < 256; ++mask) table[mask] = computeCornerToFill(mask);
  return table;
}

using Coordinates = std::array<int32_t, 3>;

uint64_t keyOf(int32_t x, int32_t y, int32_t z) {
  const auto bits = [](int32_t c) { return static_cast<uint64_t>(static_cast<uint32_t>(c + 1) & 0x1fffffu); };
  return bits(x) | bits(y) << 21 | bits(z) << 42;
}

// A lattice with fewer points than this stores all its bricks. Repairs of coarse lattices may then add points anywhere.
constexpr double kSmallLattice = 64.0 * 64.0 * 64.0;
const double kSqrt3 = std::sqrt(3.0);

}  // namespace

int32_t cornerToFill(uint32_t mask) {
  static const std::array<int8_t, 256> kTable = computeTable();
  return kTable[mask & 0xffu];
}

uint32_t CellCorners::mask(int32_t x, int32_t y, int32_t z) const {
  uint32_t mask = 0;
  for (int32_t corner = 0; corner < 8; ++corner)
    mask |= uint32_t{at(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2))} << corner;
  return mask;
}

BrickLattice::BrickLattice(const CapsuleUnion& field, double spacing)
    : field_(field.withRadiiAtLeast(spacing * kSqrt3 / 2)), spacing_(spacing) {
  // Keeps lattice points off the planes of symmetry of the shape, where mirrored capsules are equally near.
  origin_ = field_.bounds().min - Vec3d{1.37, 1.61, 1.23} * spacing;
  const Vec3d extent = field_.bounds().max - origin_ + Vec3d{2, 2, 2} * spacing;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double count = std::ceil(extent[axis] / (kBrickEdge * spacing));
    ASDFVK_CHECK_OP(count, <, 1 << 20);
    size_[axis] = static_cast<int32_t>(count);
  }
  refine();
  evaluateSigns();
  makeWellComposed();
}

Vec3d BrickLattice::position(const Brick& brick, double x, double y, double z) const {
  return origin_ + Vec3d{brick.coordinates[0] * kBrickEdge + x, brick.coordinates[1] * kBrickEdge + y,
                         brick.coordinates[2] * kBrickEdge + z} *
                       spacing_;
}

int64_t BrickLattice::find(int32_t x, int32_t y, int32_t z) const {
  const auto found = brickAt_.find(keyOf(x, y, z));
  return found == brickAt_.end() ? -1 : static_cast<int64_t>(found->second);
}

void BrickLattice::refine() {
  const double pointCount = double(size_[0]) * size_[1] * size_[2] * 512;
  int level = std::bit_width(static_cast<uint32_t>(std::max({size_[0], size_[1], size_[2]}))) - 1;
  std::vector<Coordinates> nodes;
  for (int32_t z = 0; z <= size_[2] >> level; ++z)
    for (int32_t y = 0; y <= size_[1] >> level; ++y)
      for (int32_t x = 0; x <= size_[0] >> level; ++x) nodes.push_back({x, y, z});
  for (;; --level) {
    std::vector<char> isKept(nodes.size());
    const double edge = std::ldexp(kBrickEdge * spacing_, level);
    const double reach = edge * kSqrt3 / 2 + 3 * spacing_;
    forEachBrick(nodes.size(), [&](size_t i) {
      const auto [x, y, z] = nodes[i];
      if (x << level >= size_[0] || y << level >= size_[1] || z << level >= size_[2]) return;
      const Vec3d centre = origin_ + Vec3d{x + 0.5, y + 0.5, z + 0.5} * edge;
      isKept[i] = pointCount <= kSmallLattice || std::abs(field_.value(centre)) <= reach;
    });
    std::vector<Coordinates> kept;
    for (size_t i = 0; i < nodes.size(); ++i) {
      if (!isKept[i]) continue;
      if (level == 0) {
        kept.push_back(nodes[i]);
      } else {
        for (int32_t child = 0; child < 8; ++child)
          kept.push_back(
              {2 * nodes[i][0] + (child & 1), 2 * nodes[i][1] + (child >> 1 & 1), 2 * nodes[i][2] + (child >> 2)});
      }
    }
    nodes = std::move(kept);
    if (level == 0) break;
  }
  bricks_.resize(nodes.size());
  brickAt_.reserve(nodes.size());
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    bricks_[i].coordinates = nodes[i];
    brickAt_.emplace(keyOf(nodes[i][0], nodes[i][1], nodes[i][2]), i);
  }
}

void BrickLattice::evaluateSigns() {
  forEachBrick(bricks_.size(), [&](size_t i) {
    Brick& brick = bricks_[i];
    const double half = 0.5 * kBrickEdge;
    brick.selection = field_.near(position(brick, half, half, half), (half + 2) * kSqrt3 * spacing_);
    forEachPoint([&](int32_t x, int32_t y, int32_t z) {
      if (field_.value(position(brick, x, y, z), brick.selection) < 0)
        brick.inside[static_cast<size_t>(z)] |= uint64_t{1} << (x + kBrickEdge * y);
    });
  });
}

CellCorners BrickLattice::corners(const Brick& brick) const {
  CellCorners corners;
  const auto [bx, by, bz] = brick.coordinates;
  for (int32_t slot = 0; slot < 8; ++slot) {
    const int32_t dx = slot & 1, dy = slot >> 1 & 1, dz = slot >> 2;
    const int64_t owner = find(bx + dx, by + dy, bz + dz);
    for (int32_t z = dz * kBrickEdge; z < kBrickEdge + dz; ++z)
      for (int32_t y = dy * kBrickEdge; y < kBrickEdge + dy; ++y)
        for (int32_t x = dx * kBrickEdge; x < kBrickEdge + dx; ++x) {
          // A missing brick is wholly inside or outside of the shape, so that the sign of the field is exact there.
          corners.at(x, y, z) =
              owner < 0 ? field_.value(position(brick, x, y, z)) < 0
                        : (bricks_[static_cast<size_t>(owner)].inside[static_cast<size_t>(z % kBrickEdge)] >>
                               (x % kBrickEdge + kBrickEdge * (y % kBrickEdge)) &
                           1) != 0;
        }
  }
  return corners;
}

void BrickLattice::makeWellComposed() {
  using Flips = std::vector<Coordinates>;
  // The loop ends, because every round adds points.
  for (;;) {
    std::vector<Flips> flipsOf(bricks_.size());
    forEachBrick(bricks_.size(), [&](size_t i) {
      const CellCorners signs = corners(bricks_[i]);
      forEachPoint([&](int32_t x, int32_t y, int32_t z) {
        const int32_t corner = cornerToFill(signs.mask(x, y, z));
        if (corner < 0) return;
        const auto& [bx, by, bz] = bricks_[i].coordinates;
        flipsOf[i].push_back({bx * kBrickEdge + x + (corner & 1), by * kBrickEdge + y + (corner >> 1 & 1),
                              bz * kBrickEdge + z + (corner >> 2)});
      });
    });
    bool isDone = true;
    for (const Flips& flips : flipsOf) {
      for (const auto& [x, y, z] : flips) {
        const int64_t owner = find(x / kBrickEdge, y / kBrickEdge, z / kBrickEdge);
        ASDFVK_CHECK_OP(owner, >=, 0);
        bricks_[static_cast<size_t>(owner)].inside[static_cast<size_t>(z % kBrickEdge)] |=
            uint64_t{1} << (x % kBrickEdge + kBrickEdge * (y % kBrickEdge));
        isDone = false;
      }
    }
    if (isDone) return;
  }
}

uint64_t BrickLattice::crossedEdgeCount() const {
  const auto count = [&](size_t begin, size_t end) {
    uint64_t sum = 0;
    for (size_t i = begin; i < end; ++i)
      forEachCrossedEdge(corners(bricks_[i]), [&](int, int32_t, int32_t, int32_t, bool) { ++sum; });
    return sum;
  };
  return foldInParallel<uint64_t, kBricksPerTask>(bricks_.size(), count, std::plus<>());
}

}  // namespace asdfvk
