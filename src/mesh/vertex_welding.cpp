#include "mesh/vertex_welding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/parallel.h"

namespace asdfvk {
namespace {

/// The cell of a point in a grid.
using Cell = std::array<int64_t, 3>;

struct PlacedVertex {
  Cell cell{};
  uint32_t vertex = 0;
  auto operator<=>(const PlacedVertex&) const = default;
};

/// Vertices sorted by cells of twice the distance. Two vertices within the distance are in cells that differ by at most
/// one on each axis.
class VertexGrid {
 public:
  VertexGrid(const TriangleMesh& mesh, const Normalization& unit, std::span<const uint32_t> vertices, double distance)
      : placed_(vertices.size()) {
    forEachInParallel(vertices.size(), [&](uint32_t i) {
      const Vec3d p = unit.toNormalized(mesh.vertices[vertices[i]]);
      placed_[i].vertex = vertices[i];
      for (size_t axis = 0; axis < 3; ++axis)
        placed_[i].cell[axis] = static_cast<int64_t>(std::floor(p[axis] / (2 * distance)));
    });
    sortInParallel(placed_.begin(), placed_.end());
  }

  [[nodiscard]] std::span<const PlacedVertex> placed() const { return placed_; }

  /// Calls visit(vertex) for the vertices in the cells around a cell.
  template <typename Visit>
  void forEachNear(const Cell& cell, const Visit& visit) const {
    for (int64_t x = cell[0] - 1; x <= cell[0] + 1; ++x)
      for (int64_t y = cell[1] - 1; y <= cell[1] + 1; ++y) {
        const PlacedVertex first{{x, y, cell[2] - 1}, 0};
        for (auto at = std::lower_bound(placed_.begin(), placed_.end(), first);
             at != placed_.end() && at->cell[0] == x && at->cell[1] == y && at->cell[2] <= cell[2] + 1; ++at)
          visit(at->vertex);
      }
  }

 private:
  std::vector<PlacedVertex> placed_;
};

}  // namespace

std::vector<uint32_t> weldVertices(const TriangleMesh& mesh, const Normalization& unit,
                                   std::span<const uint32_t> vertices, double distance) {
  std::vector<uint32_t> replacement(mesh.vertices.size());
  std::iota(replacement.begin(), replacement.end(), 0u);
  const VertexGrid grid(mesh, unit, vertices, distance);
  const auto isNear = [&](uint32_t a, uint32_t b) {
    return length(unit.toNormalized(mesh.vertices[a]) - unit.toNormalized(mesh.vertices[b])) <= distance;
  };
  // Whether a lower vertex may replace it; most vertices of a mesh have none nearby.
  std::vector<uint32_t> lowest(vertices.size());
  forEachInParallel(vertices.size(), [&](uint32_t i) {
    const PlacedVertex& placed = grid.placed()[i];
    lowest[i] = placed.vertex;
    grid.forEachNear(placed.cell, [&](uint32_t other) {
      if (other < lowest[i] && isNear(placed.vertex, other)) lowest[i] = other;
    });
  });
  std::vector<PlacedVertex> order;
  for (uint32_t i = 0; i < lowest.size(); ++i)
    if (lowest[i] != grid.placed()[i].vertex) order.push_back(grid.placed()[i]);
  std::sort(order.begin(), order.end(),
            [](const PlacedVertex& a, const PlacedVertex& b) { return a.vertex < b.vertex; });
  for (const PlacedVertex& placed : order) {
    uint32_t& found = replacement[placed.vertex];
    grid.forEachNear(placed.cell, [&](uint32_t other) {
      if (other < found && replacement[other] == other && isNear(placed.vertex, other)) found = other;
    });
  }
  return replacement;
}

}  // namespace asdfvk
