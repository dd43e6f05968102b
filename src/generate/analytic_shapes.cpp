#include "generate/analytic_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asdfvk {
namespace {

/// A cylinder mesh. The mantle consists of layers along z, with 6 * ringCount vertices each. Two discs close the
/// mantle; ring k of a disc has 6 k vertices.
class CylinderGrid {
 public:
  CylinderGrid(double radius, double length, uint32_t ringCount, uint32_t layerCount)
      : radius_(radius), ringCount_(ringCount), around_(6 * ringCount), layerCount_(layerCount) {
    for (uint32_t layer = 0; layer <= layerCount_; ++layer)
      addRing(ringCount_, length * (double(layer) / layerCount_ - 0.5));
    for (uint32_t layer = 0; layer < layerCount_; ++layer) {
      for (uint32_t q = 0; q < around_; ++q) {
        const uint32_t a = layer * around_ + q, b = layer * around_ + (q + 1) % around_;
        mesh_.faces.push_back({a, b, b + around_});
        mesh_.faces.push_back({a, b + around_, a + around_});
      }
    }
    addDisc(0, -0.5 * length, true);
    addDisc(layerCount_ * around_, 0.5 * length, false);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void addRing(uint32_t ring, double z) {
    const double radius = radius_ * (double(ring) / ringCount_);
    for (uint32_t q = 0; q < std::max(1u, 6 * ring); ++q) {
      const double angle = 2 * std::numbers::pi * q / std::max(1u, 6 * ring);
      mesh_.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }

  void addDisc(uint32_t firstOfRim, double z, bool downwards) {
    const auto addFace = [&](uint32_t a, uint32_t b, uint32_t c) {
      if (downwards) std::swap(b, c);
      mesh_.faces.push_back({a, b, c});
    };
    auto inner = static_cast<uint32_t>(mesh_.vertices.size());
    addRing(0, z);
    for (uint32_t ring = 1; ring <= ringCount_; ++ring) {
      uint32_t outer = firstOfRim;
      if (ring < ringCount_) {
        outer = static_cast<uint32_t>(mesh_.vertices.size());
        addRing(ring, z);
      }
      const uint32_t innerCount = std::max(1u, 6 * (ring - 1));
      for (uint32_t q = 0; q < 6 * ring; ++q) {
        const uint32_t sector = q / ring, step = q % ring;
        const uint32_t a = outer + q, b = outer + (q + 1) % (6 * ring);
        const uint32_t i = inner + (sector * (ring - 1) + step) % innerCount;
        addFace(a, b, i);
        if (step + 1 < ring) addFace(i, b, inner + (sector * (ring - 1) + step + 1) % innerCount);
      }
      inner = outer;
    }
  }

  double radius_;
  uint32_t ringCount_, around_, layerCount_;
  Mesh mesh_;
};

}  // namespace

GeneratedShape makeCylinder(uint64_t faceCount, double radius, double length) {
  // With r rings, the two discs have 12 r^2 faces, and a layer of the mantle has 12 r faces. r is chosen for equally
  // long edges, and the number of layers for faceCount.
  const double layersPerRing = length / radius * (3 / std::numbers::pi);
  const double wished = std::max(1.0, std::round(std::sqrt(double(faceCount) / (12 * (1 + layersPerRing)))));
  const double layers = std::max(1.0, std::round((double(faceCount) - 12 * wished * wished) / (12 * wished)));
  CylinderGrid grid(radius, length, static_cast<uint32_t>(wished), static_cast<uint32_t>(layers));
  return withUniformDiameter(grid.take(), 2 * radius);
}

GeneratedShape makeTorus(uint64_t faceCount, double ringRadius, double tubeRadius) {
  const double quads = double(faceCount) / 2;
  const double tube = std::max(3.0, std::round(std::sqrt(quads * tubeRadius / ringRadius)));
  const auto tubeCount = static_cast<uint32_t>(tube);
  const auto ringCount = static_cast<uint32_t>(std::max(3.0, std::round(quads / tube)));
  Mesh mesh;
  for (uint32_t i = 0; i < ringCount; ++i) {
    const double u = 2 * std::numbers::pi * i / ringCount;
    for (uint32_t j = 0; j < tubeCount; ++j) {
      const double v = 2 * std::numbers::pi * j / tubeCount;
      const double fromAxis = ringRadius + tubeRadius * std::cos(v);
      mesh.vertices.push_back({fromAxis * std::cos(u), fromAxis * std::sin(u), tubeRadius * std::sin(v)});
    }
  }
  for (uint32_t i = 0; i < ringCount; ++i) {
    const uint32_t row = i * tubeCount, nextRow = (i + 1) % ringCount * tubeCount;
    for (uint32_t j = 0; j < tubeCount; ++j) {
      const uint32_t next = (j + 1) % tubeCount;
      mesh.faces.push_back({row + j, nextRow + j, nextRow + next});
      mesh.faces.push_back({row + j, nextRow + next, row + next});
    }
  }
  return withUniformDiameter(std::move(mesh), 2 * tubeRadius);
}

}  // namespace asdfvk
