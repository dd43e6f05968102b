#include "generate/surface_nets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "generate/brick_lattice.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNone = ~uint32_t{0};
constexpr int kEveningRounds = 4;

/// The cells of a brick that the surface crosses ("crossed" cells), and the indices of the first vertex and of the
/// first quad of the brick.
struct BrickCells {
  std::array<uint64_t, 8> crossed{};
  std::array<uint16_t, 8> countBefore{};  ///< Number of crossed cells of the brick below layer z.
  uint32_t firstVertex = 0;
  uint32_t firstQuad = 0;
};

class SurfaceNets {
 public:
  SurfaceNets(const CapsuleUnion& field, const BrickLattice& lattice) : field_(field), lattice_(lattice) {
    findCells();
    placeVertices();
    for (int round = 0; round < kEveningRounds; ++round) moveVertices(0.7, 1);
    moveVertices(0, 4);
    addFaces();
  }

  GeneratedShape take() { return std::move(shape_); }

 private:
  /// Calls use(x, y, z) for the crossed cells of a brick in the order of their vertices.
  template <typename Use>
  void forEachCell(size_t brick, Use use) const {
    for (int32_t z = 0; z < kBrickEdge; ++z)
      for (uint64_t bits = cells_[brick].crossed[static_cast<size_t>(z)]; bits != 0; bits &= bits - 1) {
        const int32_t bit = std::countr_zero(bits);
        use(bit % kBrickEdge, bit / kBrickEdge, z);
      }
  }

  void findCells() {
    cells_.resize(lattice_.bricks().size());
    forEachBrick(cells_.size(), [&](size_t i) {
      const CellCorners signs = lattice_.corners(lattice_.bricks()[i]);
      BrickCells& cells = cells_[i];
      for (int32_t z = 0; z < kBrickEdge; ++z) {
        cells.countBefore[static_cast<size_t>(z)] = static_cast<uint16_t>(cells.firstVertex);
        for (int32_t y = 0; y < kBrickEdge; ++y)
          for (int32_t x = 0; x < kBrickEdge; ++x) {
            const uint32_t mask = signs.mask(x, y, z);
            if (mask == 0 || mask == 0xff) continue;
            cells.crossed[static_cast<size_t>(z)] |= uint64_t{1} << (x + kBrickEdge * y);
            ++cells.firstVertex;  // Here a count. The prefix sums below replace the count by an index.
          }
      }
      forEachCrossedEdge(signs, [&](int, int32_t, int32_t, int32_t, bool) { ++cells.firstQuad; });
    });
    uint64_t vertexCount = 0, quadCount = 0;
    for (BrickCells& cells : cells_) {
      vertexCount += std::exchange(cells.firstVertex, static_cast<uint32_t>(vertexCount));
      quadCount += std::exchange(cells.firstQuad, static_cast<uint32_t>(quadCount));
    }
    ASDFVK_CHECK_OP(quadCount, <, kNone / 2);
    shape_.mesh.vertices.resize(vertexCount);
    shape_.mesh.faces.resize(2 * quadCount);
    shape_.part.resize(2 * quadCount);
    shape_.diameter.resize(2 * quadCount);
  }

  /// The vertex of a cell in the brick or in an adjacent brick; kNone if the surface does not cross the cell.
  [[nodiscard]] uint32_t vertexOf(size_t brick, int32_t x, int32_t y, int32_t z) const {
    if (((x | y | z) & ~(kBrickEdge - 1)) != 0) {
      const auto floorDivide = [](int32_t c) { return c < 0 ? -1 : c / kBrickEdge; };
      const auto [bx, by, bz] = lattice_.bricks()[brick].coordinates;
      const int64_t other = lattice_.find(bx + floorDivide(x), by + floorDivide(y), bz + floorDivide(z));
      if (other < 0) return kNone;
      brick = static_cast<size_t>(other);
      x &= kBrickEdge - 1, y &= kBrickEdge - 1, z &= kBrickEdge - 1;
    }
    const BrickCells& cells = cells_[brick];
    const uint64_t layer = cells.crossed[static_cast<size_t>(z)];
    const int32_t bit = x + kBrickEdge * y;
    if ((layer >> bit & 1) == 0) return kNone;
    const auto before = static_cast<uint32_t>(std::popcount(layer & ((uint64_t{1} << bit) - 1)));
    return cells.firstVertex + cells.countBefore[static_cast<size_t>(z)] + before;
  }

  void placeVertices() {
    neighbours_.resize(shape_.mesh.vertices.size());
    forEachBrick(cells_.size(), [&](size_t i) {
      const Brick& brick = lattice_.bricks()[i];
      const CellCorners signs = lattice_.corners(brick);
      uint32_t vertex = cells_[i].firstVertex;
      forEachCell(i, [&](int32_t x, int32_t y, int32_t z) {
        shape_.mesh.vertices[vertex] = lattice_.position(brick, x + 0.5, y + 0.5, z + 0.5);
        const uint32_t mask = signs.mask(x, y, z);
        // For each axis, the masks of the corners of the lower and of the upper side of a cell.
        constexpr std::array<uint32_t, 6> kSides{0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0};
        for (size_t side = 0; side < 6; ++side) {
          const uint32_t onSide = mask & kSides[side];
          const int32_t step = side % 2 == 0 ? -1 : 1;
          neighbours_[vertex][side] = onSide == 0 || onSide == kSides[side]
                                          ? kNone
                                          : vertexOf(i, x + (side / 2 == 0 ? step : 0), y + (side / 2 == 1 ? step : 0),
                                                     z + (side / 2 == 2 ? step : 0));
        }
        ++vertex;
      });
    });
  }

  /// Moves each vertex by `share` of the way to the mean of its neighbours, then by Newton steps to the surface. Along
  /// each axis, a vertex stays within one spacing of the centre of its cell.
  void moveVertices(double share, int newtonSteps) {
    const std::vector<Vec3d>& from = shape_.mesh.vertices;
    std::vector<Vec3d> to(from.size());
    forEachBrick(cells_.size(), [&](size_t i) {
      const Brick& brick = lattice_.bricks()[i];
      uint32_t vertex = cells_[i].firstVertex;
      forEachCell(i, [&](int32_t x, int32_t y, int32_t z) {
        Vec3d p = from[vertex];
        if (share > 0) {
          Vec3d sum;
          int count = 0;
          for (const uint32_t neighbour : neighbours_[vertex]) {
            if (neighbour == kNone) continue;
            sum += from[neighbour];
            ++count;
          }
          p += (sum / double(count) - p) * share;
        }
        for (int step = 0; step < newtonSteps; ++step) p += newtonStep(p, brick.selection);
        const Vec3d centre = lattice_.position(brick, x + 0.5, y + 0.5, z + 0.5);
        for (size_t axis = 0; axis < 3; ++axis)
          p[axis] = std::clamp(p[axis], centre[axis] - lattice_.spacing(), centre[axis] + lattice_.spacing());
        to[vertex++] = p;
      });
    });
    shape_.mesh.vertices = std::move(to);
  }

  [[nodiscard]] Vec3d newtonStep(const Vec3d& p, CapsuleUnion::Selection selection) const {
    const CapsuleUnion::Sample sample = field_.sample(p, selection);
    // Midway between two limbs the gradients cancel. The lower bound prevents a Newton step that is too long.
    const double squared = std::max(0.05, dot(sample.gradient, sample.gradient));
    return sample.gradient * (-sample.value / squared);
  }

  void addFaces() {
    forEachBrick(cells_.size(), [&](size_t i) {
      const Brick& brick = lattice_.bricks()[i];
      size_t face = 2 * size_t{cells_[i].firstQuad};
      forEachCrossedEdge(lattice_.corners(brick), [&](int axis, int32_t x, int32_t y, int32_t z, bool isInside) {
        const int32_t ux = axis == 2, uy = axis == 0, uz = axis == 1;  // Unit vector of the next axis.
        const int32_t vx = axis == 1, vy = axis == 2, vz = axis == 0;  // Unit vector of the axis after the next.
        std::array<uint32_t, 4> quad{vertexOf(i, x - ux - vx, y - uy - vy, z - uz - vz),
                                     vertexOf(i, x - vx, y - vy, z - vz), vertexOf(i, x, y, z),
                                     vertexOf(i, x - ux, y - uy, z - uz)};
        if (!isInside) std::swap(quad[1], quad[3]);
        addQuad(face, quad, brick.selection);
        face += 2;
      });
    });
  }

  void addQuad(size_t face, const std::array<uint32_t, 4>& q, CapsuleUnion::Selection selection) {
    const std::array<Face, 2> one{Face{q[0], q[1], q[2]}, Face{q[0], q[2], q[3]}};
    const std::array<Face, 2> other{Face{q[0], q[1], q[3]}, Face{q[1], q[2], q[3]}};
    const auto worst = [&](const std::array<Face, 2>& pair) { return std::min(quality(pair[0]), quality(pair[1])); };
    const auto& chosen = worst(other) > worst(one) ? other : one;
    for (size_t k = 0; k < 2; ++k) {
      const auto [a, b, c] = shape_.mesh.faces[face + k] = chosen[k];
      const std::vector<Vec3d>& at = shape_.mesh.vertices;
      const CapsuleUnion::Dominating capsule = field_.dominating((at[a] + at[b] + at[c]) / 3.0, selection);
      shape_.part[face + k] = capsule.part;
      shape_.diameter[face + k] = static_cast<float>(capsule.diameter);
    }
  }

  /// Twice the area, divided by the sum of the squared edge lengths.
  [[nodiscard]] double quality(const Face& face) const {
    const std::vector<Vec3d>& at = shape_.mesh.vertices;
    const Vec3d ab = at[face[1]] - at[face[0]], ac = at[face[2]] - at[face[0]], bc = ac - ab;
    return length(cross(ab, ac)) / (dot(ab, ab) + dot(ac, ac) + dot(bc, bc));
  }

  const CapsuleUnion& field_;
  const BrickLattice& lattice_;
  std::vector<BrickCells> cells_;
  /// For each vertex: the vertices of the six cells beside the cell of the vertex; kNone for a cell without a vertex.
  std::vector<std::array<uint32_t, 6>> neighbours_;
  GeneratedShape shape_;
};

/// A lattice with about `quadCount` edges that the surface crosses: within 2 %, or the best of the tested spacings.
/// The number of crossed edges is about proportional to 1 / spacing^2. The approximation is better for finer lattices.
BrickLattice latticeOfSize(const CapsuleUnion& field, uint64_t quadCount) {
  const auto wished = static_cast<double>(quadCount);
  double spacing = field.bounds().diagonal() / 20;
  std::optional<BrickLattice> best;
  double bestError = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 16 && bestError > 0.02; ++attempt) {
    BrickLattice lattice(field, spacing);
    const double ratio = double(lattice.crossedEdgeCount()) / wished;
    const double error = std::abs(std::log(ratio));
    if (error < bestError) {
      bestError = error;
      best.emplace(std::move(lattice));
    }
    // The number of quads of a coarse lattice jumps with the spacing. Shorter steps find counts between two jumps.
    const double power = attempt < 6 ? 0.5 : 0.2;
    spacing *= std::pow(std::clamp(ratio, 1.0 / 64, 64.0), power);
  }
  return std::move(*best);
}

}  // namespace

GeneratedShape polygonise(const CapsuleUnion& field, uint64_t faceCount) {
  const BrickLattice lattice = latticeOfSize(field, faceCount / 2);
  return SurfaceNets(field, lattice).take();
}

}  // namespace asdfvk
