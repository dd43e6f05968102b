#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "generate/analytic_shapes.h"
#include "generate/icosahedron.h"

namespace asdfvk {
namespace {

/// The vertices of an icosahedron whose edges are divided into n: corners first, then edges, then the interiors of its
/// sides.
class GeodesicGrid {
 public:
  GeodesicGrid(uint32_t n, double radius) : n_(n), radius_(radius) {
    for (const Vec3d& corner : icosahedron_.vertices) addVertex(corner);
    for (const auto& side : icosahedron_.faces) {
      for (size_t e = 0; e < 3; ++e) addEdge(side[e], side[(e + 1) % 3]);
    }
    for (const auto& side : icosahedron_.faces) addSide(side);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void addVertex(const Vec3d& p) { mesh_.vertices.push_back(p * (radius_ / length(p))); }

  void addEdge(uint32_t from, uint32_t to) {
    if (from > to) std::swap(from, to);
    if (!firstOnEdge_.emplace(std::pair(from, to), static_cast<uint32_t>(mesh_.vertices.size())).second) return;
    const Vec3d &a = icosahedron_.vertices[from], &b = icosahedron_.vertices[to];
    for (uint32_t i = 1; i < n_; ++i) addVertex(a * double(n_ - i) + b * double(i));
  }

  [[nodiscard]] uint32_t onEdge(uint32_t from, uint32_t to, uint32_t step) const {
    if (step == 0) return from;
    if (step == n_) return to;
    if (from > to) return firstOnEdge_.at({to, from}) + (n_ - step) - 1;
    return firstOnEdge_.at({from, to}) + step - 1;
  }

  // Row i runs from edge (0, 1) to edge (0, 2) of the side, with i + 1 vertices.
  void addSide(const std::array<uint32_t, 3>& side) {
    const auto [c0, c1, c2] = side;
    const Vec3d &a = icosahedron_.vertices[c0], &b = icosahedron_.vertices[c1], &c = icosahedron_.vertices[c2];
    std::vector<uint32_t> above{c0}, row;
    for (uint32_t i = 1; i <= n_; ++i) {
      row.clear();
      for (uint32_t j = 0; j <= i; ++j) {
        if (i == n_) {
          row.push_back(onEdge(c1, c2, j));
        } else if (j == 0) {
          row.push_back(onEdge(c0, c1, i));
        } else if (j == i) {
          row.push_back(onEdge(c0, c2, i));
        } else {
          row.push_back(static_cast<uint32_t>(mesh_.vertices.size()));
          addVertex(a * double(n_ - i) + b * double(i - j) + c * double(j));
        }
      }
      for (uint32_t j = 0; j < i; ++j) {
        mesh_.faces.push_back({above[j], row[j], row[j + 1]});
        if (j + 1 < i) mesh_.faces.push_back({above[j], row[j + 1], above[j + 1]});
      }
      std::swap(above, row);
    }
  }

  Icosahedron icosahedron_ = unitIcosahedron();
  uint32_t n_;
  double radius_;
  Mesh mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> firstOnEdge_;
};

}  // namespace

GeneratedShape makeSphere(uint64_t faceCount, const SphereParameters& parameters) {
  const auto n = static_cast<uint32_t>(std::max(1.0, std::round(std::sqrt(double(faceCount) / 20))));
  return withUniformDiameter(GeodesicGrid(n, parameters.radius).take(), 2 * parameters.radius);
}

}  // namespace asdfvk
