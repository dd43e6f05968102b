#include <algorithm>
#include <array>
#include <cmath>

#include "generate/analytic_shapes.h"

namespace asdfvk {
namespace {

/// The lattice points on the surface of an nx x ny x nz box, once each: bottom layer, nz - 1 rims, top layer.
class BoxGrid {
 public:
  BoxGrid(const Vec3d& size, std::array<uint32_t, 3> cells) : size_(size), nx_(cells[0]), ny_(cells[1]), nz_(cells[2]) {
    for (uint32_t k = 0; k <= nz_; ++k) {
      if (k == 0 || k == nz_) {
        for (uint32_t j = 0; j <= ny_; ++j)
          for (uint32_t i = 0; i <= nx_; ++i) addVertex(i, j, k);
      } else {
        for (uint32_t q = 0; q < rimCount(); ++q) {
          const auto [i, j] = onRim(q);
          addVertex(i, j, k);
        }
      }
    }
    for (uint32_t j = 0; j < ny_; ++j) {
      for (uint32_t i = 0; i < nx_; ++i) {
        const bool flip = (i + j) % 2 == 1;
        addQuad(inLayer(i, j, 0), inLayer(i, j + 1, 0), inLayer(i + 1, j + 1, 0), inLayer(i + 1, j, 0), flip);
        addQuad(inLayer(i, j, nz_), inLayer(i + 1, j, nz_), inLayer(i + 1, j + 1, nz_), inLayer(i, j + 1, nz_), flip);
      }
    }
    for (uint32_t k = 0; k < nz_; ++k) {
      for (uint32_t q = 0; q < rimCount(); ++q) {
        const uint32_t next = (q + 1) % rimCount();
        addQuad(rimVertex(q, k), rimVertex(next, k), rimVertex(next, k + 1), rimVertex(q, k + 1), (q + k) % 2 == 1);
      }
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  [[nodiscard]] uint32_t rimCount() const { return 2 * (nx_ + ny_); }
  [[nodiscard]] uint32_t layerCount() const { return (nx_ + 1) * (ny_ + 1); }

  // The rim runs counter-clockwise seen from +z.
  [[nodiscard]] std::array<uint32_t, 2> onRim(uint32_t q) const {
    if (q < nx_) return {q, 0};
    if (q < nx_ + ny_) return {nx_, q - nx_};
    if (q < 2 * nx_ + ny_) return {2 * nx_ + ny_ - q, ny_};
    return {0, rimCount() - q};
  }

  [[nodiscard]] uint32_t inLayer(uint32_t i, uint32_t j, uint32_t k) const {
    const uint32_t base = k == 0 ? 0 : layerCount() + (nz_ - 1) * rimCount();
    return base + j * (nx_ + 1) + i;
  }

  [[nodiscard]] uint32_t rimVertex(uint32_t q, uint32_t k) const {
    if (k > 0 && k < nz_) return layerCount() + (k - 1) * rimCount() + q;
    const auto [i, j] = onRim(q);
    return inLayer(i, j, k);
  }

  void addVertex(uint32_t i, uint32_t j, uint32_t k) {
    mesh_.vertices.push_back(
        {size_.x * (double(i) / nx_ - 0.5), size_.y * (double(j) / ny_ - 0.5), size_.z * (double(k) / nz_ - 0.5)});
  }

  void addQuad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool flip) {
    if (flip) {
      mesh_.faces.push_back({a, b, d});
      mesh_.faces.push_back({b, c, d});
    } else {
      mesh_.faces.push_back({a, b, c});
      mesh_.faces.push_back({a, c, d});
    }
  }

  Vec3d size_;
  uint32_t nx_, ny_, nz_;
  Mesh mesh_;
};

}  // namespace

GeneratedShape makeBox(uint64_t faceCount, const Vec3d& size) {
  // Two triangles per square cell, and at least one cell per direction.
  const double cellArea = 4 * (size.x * size.y + size.y * size.z + size.z * size.x) / double(faceCount);
  const double edge = std::sqrt(cellArea);
  const auto cells = [&](double extent) { return static_cast<uint32_t>(std::max(1.0, std::round(extent / edge))); };
  return withUniformDiameter(BoxGrid(size, {cells(size.x), cells(size.y), cells(size.z)}).take(),
                             std::min({size.x, size.y, size.z}));
}

GeneratedShape makeSlab(uint64_t faceCount, double width, double thickness) {
  return makeBox(faceCount, {width, width, thickness});
}

GeneratedShape makeCube(uint64_t faceCount, double edge) { return makeBox(faceCount, {edge, edge, edge}); }

}  // namespace asdfvk
