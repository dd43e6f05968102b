#include "generate/block_solid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "core/random.h"

namespace asdfvk {
namespace {

/// Corners of the sides of a block, counter-clockwise from outside.
constexpr std::array<std::array<uint32_t, 4>, 6> kBlockSides{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

uint32_t axisBetween(uint32_t corner, uint32_t other) { return (corner ^ other) >> 1; }  // Maps 1, 2, 4 to 0, 1, 2.

/// Sets of edges of blocks. The edges of a set are divided into the same number of parts.
class EdgeSets {
 public:
  using Edge = std::pair<uint32_t, uint32_t>;

  size_t add(uint32_t a, uint32_t b, double length) {
    const auto [at, isNew] = indices_.try_emplace(std::minmax(a, b), parents_.size());
    if (isNew) {
      parents_.push_back(at->second);
      longest_.push_back(length);
    }
    return at->second;
  }

  void join(size_t edge, size_t other) {
    const size_t a = rootOf(edge), b = rootOf(other);
    longest_[a] = std::max(longest_[a], longest_[b]);
    parents_[b] = a;
  }

  [[nodiscard]] double longestLike(uint32_t a, uint32_t b) { return longest_[rootOf(indices_.at(std::minmax(a, b)))]; }

 private:
  size_t rootOf(size_t edge) {
    while (parents_[edge] != edge) edge = parents_[edge] = parents_[parents_[edge]];
    return edge;
  }

  std::map<Edge, size_t> indices_;
  std::vector<size_t> parents_;
  std::vector<double> longest_;
};

/// The triangles of divided quads. Integer weights of corners identify a vertex that neighbouring quads share.
class QuadDivider {
 public:
  QuadDivider(const std::vector<Vec3d>& corners, const SurfaceDivision& division)
      : corners_(corners), random_(division.diagonalSeed), shift_(division.otherDiagonals ? 1 : 0) {}

  /// nu, nv: numbers of parts of the two edges at the first corner; the edge of nu ends at the second corner.
  void divide(const std::array<uint32_t, 4>& quad, uint64_t nu, uint64_t nv) {
    const auto vertex = [&](uint64_t u, uint64_t v) {
      return vertexOf(quad, {(nu - u) * (nv - v), u * (nv - v), u * v, (nu - u) * v});
    };
    for (uint64_t u = 0; u < nu; ++u)
      for (uint64_t v = 0; v < nv; ++v) {
        const std::array<uint32_t, 4> q{vertex(u, v), vertex(u + 1, v), vertex(u + 1, v + 1), vertex(u, v + 1)};
        const uint32_t first = random_.index(2) ^ shift_;
        addFace({q[first], q[first + 1], q[first + 2]});
        addFace({q[first], q[first + 2], q[(first + 3) % 4]});
      }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  using Weights = std::vector<std::pair<uint32_t, uint64_t>>;  // Pairs of corner and weight, sorted by corner.

  uint32_t vertexOf(const std::array<uint32_t, 4>& quad, const std::array<uint64_t, 4>& weights) {
    std::map<uint32_t, uint64_t> sums;
    uint64_t divisor = 0, total = 0;
    for (size_t i = 0; i < 4; ++i)
      if (weights[i] > 0) sums[quad[i]] += weights[i];
    for (const auto& [corner, weight] : sums) divisor = std::gcd(divisor, weight);
    Vec3d position;
    for (auto& [corner, weight] : sums) {
      weight /= divisor;
      total += weight;
      position += static_cast<double>(weight) * corners_[corner];
    }
    const auto [at, isNew] =
        vertices_.try_emplace(Weights(sums.begin(), sums.end()), static_cast<uint32_t>(mesh_.vertices.size()));
    if (isNew) mesh_.vertices.push_back(position / static_cast<double>(total));
    return at->second;
  }

  void addFace(const Face& face) {
    if (hasDistinctVertices(face)) mesh_.faces.push_back(face);
  }

  const std::vector<Vec3d>& corners_;
  Random random_;
  uint32_t shift_;
  std::map<Weights, uint32_t> vertices_;
  Mesh mesh_;
};

}  // namespace

uint32_t BlockSolid::cornerAt(const Vec3d& position) {
  const auto [at, isNew] =
      cornerOf_.try_emplace({position.x, position.y, position.z}, static_cast<uint32_t>(corners_.size()));
  if (isNew) corners_.push_back(position);
  return at->second;
}

void BlockSolid::addBlock(Block block) {
  std::array<Vec3d, 3> axes;
  for (uint32_t i = 0; i < 8; ++i)
    for (uint32_t axis = 0; axis < 3; ++axis)
      axes[axis] += (i >> axis & 1) != 0 ? corners_[block[i]] : -corners_[block[i]];
  if (dot(cross(axes[0], axes[1]), axes[2]) < 0)
    for (uint32_t i = 0; i < 8; i += 2) std::swap(block[i], block[i + 1]);
  blocks_.push_back(block);
}

void BlockSolid::addLattice(const std::array<uint32_t, 3>& cellCounts,
                            const std::function<Vec3d(uint32_t, uint32_t, uint32_t)>& position,
                            const std::function<bool(uint32_t, uint32_t, uint32_t)>& isFilled) {
  for (uint32_t k = 0; k < cellCounts[2]; ++k)
    for (uint32_t j = 0; j < cellCounts[1]; ++j)
      for (uint32_t i = 0; i < cellCounts[0]; ++i) {
        if (isFilled && !isFilled(i, j, k)) continue;
        Block block{};
        for (uint32_t c = 0; c < 8; ++c) block[c] = cornerAt(position(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)));
        addBlock(block);
      }
}

/// For each block, the numbers of parts of its edges along each axis.
std::vector<std::array<uint32_t, 3>> BlockSolid::divide(double longestEdge) const {
  EdgeSets sets;
  const auto forEachEdge = [](const Block& block, uint32_t axis, const auto& visit) {
    for (uint32_t c = 0; c < 8; ++c)
      if (const uint32_t a = block[c], b = block[c | 1u << axis]; a != b) visit(a, b);
  };
  for (const Block& block : blocks_)
    for (uint32_t axis = 0; axis < 3; ++axis) {
      std::vector<size_t> parallel;
      forEachEdge(block, axis, [&](uint32_t a, uint32_t b) {
        parallel.push_back(sets.add(a, b, length(corners_[a] - corners_[b])));
      });
      for (const size_t set : parallel) sets.join(parallel[0], set);
    }
  std::vector<std::array<uint32_t, 3>> counts(blocks_.size());
  for (size_t i = 0; i < blocks_.size(); ++i)
    for (uint32_t axis = 0; axis < 3; ++axis)
      forEachEdge(blocks_[i], axis, [&](uint32_t a, uint32_t b) {
        counts[i][axis] = std::max(1u, static_cast<uint32_t>(std::ceil(sets.longestLike(a, b) / longestEdge)));
      });
  return counts;
}

Mesh BlockSolid::surface(const SurfaceDivision& division) const {
  const auto cornersOf = [&](const Block& block, const std::array<uint32_t, 4>& side) {
    return std::array<uint32_t, 4>{block[side[0]], block[side[1]], block[side[2]], block[side[3]]};
  };
  const auto keyOf = [](const std::array<uint32_t, 4>& quad) { return std::set<uint32_t>(quad.begin(), quad.end()); };
  std::map<std::set<uint32_t>, uint32_t> blockCounts;
  for (const Block& block : blocks_)
    for (const auto& side : kBlockSides) ++blockCounts[keyOf(cornersOf(block, side))];
  const std::vector<std::array<uint32_t, 3>> counts = divide(division.longestEdge);
  QuadDivider divider(corners_, division);
  for (size_t i = 0; i < blocks_.size(); ++i)
    for (const auto& side : kBlockSides) {
      const std::array<uint32_t, 4> quad = cornersOf(blocks_[i], side);
      const std::set<uint32_t> key = keyOf(quad);
      if (blockCounts[key] == 1 && key.size() > 2)  // The side is not collapsed.
        divider.divide(quad, counts[i][axisBetween(side[0], side[1])], counts[i][axisBetween(side[0], side[3])]);
    }
  return divider.take();
}

void addDraftedLattice(BlockSolid& solid, const std::vector<DraftedPlane>& xs, const std::vector<DraftedPlane>& ys,
                       const std::vector<double>& zs,
                       const std::function<bool(uint32_t, uint32_t, uint32_t)>& isFilled) {
  const auto cellCountOf = [](const auto& planes) { return static_cast<uint32_t>(planes.size()) - 1; };
  solid.addLattice(
      {cellCountOf(xs), cellCountOf(ys), cellCountOf(zs)},
      [&](uint32_t i, uint32_t j, uint32_t k) {
        return Vec3d{xs[i].at(zs[k]), ys[j].at(zs[k]), zs[k]};
      },
      isFilled);
}

}  // namespace asdfvk
