#include "generate/analytic_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "generate/icosahedron.h"
#include "io/corner_welder.h"

namespace asdfvk {
namespace {

/// An icosahedron whose edges are divided into n parts, projected onto a sphere.
Mesh geodesicMesh(uint32_t n, double radius) {
  const Icosahedron icosahedron = unitIcosahedron();
  CornerWelder welder(uint64_t{10} * n * n + 2);
  Mesh mesh;
  for (const auto& side : icosahedron.faces) {
    const Vec3d &a = icosahedron.vertices[side[0]], &b = icosahedron.vertices[side[1]],
                &c = icosahedron.vertices[side[2]];
    // Row i runs from edge (a, b) to edge (a, c), with i + 1 vertices. Sides with a common edge have the same bits
    // there.
    std::vector<uint32_t> above, row;
    for (uint32_t i = 0; i <= n; ++i) {
      row.clear();
      for (uint32_t j = 0; j <= i; ++j) {
        const Vec3d p = a * double(n - i) + b * double(i - j) + c * double(j);
        row.push_back(welder.indexOf(p * (radius / length(p))));
      }
      for (uint32_t j = 0; j < i; ++j) {
        mesh.faces.push_back({above[j], row[j], row[j + 1]});
        if (j + 1 < i) mesh.faces.push_back({above[j], row[j + 1], above[j + 1]});
      }
      std::swap(above, row);
    }
  }
  mesh.vertices = std::move(welder.points());
  return mesh;
}

/// The surface of a box of nx x ny x nz cells, with two triangles per square. The bottom and the top come first, and
/// then the rims from bottom to top.
Mesh boxMesh(const Vec3d& size, uint32_t nx, uint32_t ny, uint32_t nz) {
  CornerWelder welder(2 * (uint64_t{nx} * ny + uint64_t{ny} * nz + uint64_t{nz} * nx));
  Mesh mesh;
  const auto vertex = [&](const std::array<uint32_t, 2>& ij, uint32_t k) {
    return welder.indexOf(
        {size.x * (double(ij[0]) / nx - 0.5), size.y * (double(ij[1]) / ny - 0.5), size.z * (double(k) / nz - 0.5)});
  };
  const auto addQuad = [&](const std::array<uint32_t, 4>& q, bool flip) {
    mesh.faces.push_back({q[0], q[1], q[flip ? 3 : 2]});
    mesh.faces.push_back({q[flip ? 1 : 0], q[2], q[3]});
  };
  for (uint32_t j = 0; j < ny; ++j)
    for (uint32_t i = 0; i < nx; ++i)
      for (const uint32_t k : {0u, nz}) {
        const std::array<uint32_t, 2> along{i + 1, j}, across{i, j + 1};
        const bool isTop = k > 0;
        addQuad({vertex({i, j}, k), vertex(isTop ? along : across, k), vertex({i + 1, j + 1}, k),
                 vertex(isTop ? across : along, k)},
                (i + j) % 2 == 1);
      }
  const uint32_t rimCount = 2 * (nx + ny);
  // The rim runs counter-clockwise seen from +z.
  const auto onRim = [&](uint32_t q) -> std::array<uint32_t, 2> {
    if (q < nx) return {q, 0};
    if (q < nx + ny) return {nx, q - nx};
    return q < 2 * nx + ny ? std::array<uint32_t, 2>{2 * nx + ny - q, ny} : std::array<uint32_t, 2>{0, rimCount - q};
  };
  for (uint32_t k = 0; k < nz; ++k)
    for (uint32_t q = 0; q < rimCount; ++q) {
      const std::array<uint32_t, 2> here = onRim(q), next = onRim((q + 1) % rimCount);
      addQuad({vertex(here, k), vertex(next, k), vertex(next, k + 1), vertex(here, k + 1)}, (q + k) % 2 == 1);
    }
  mesh.vertices = std::move(welder.points());
  return mesh;
}

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

GeneratedShape makeSphere(uint64_t faceCount, double radius) {
  const auto n = static_cast<uint32_t>(std::max(1.0, std::round(std::sqrt(double(faceCount) / 20))));
  return withUniformDiameter(geodesicMesh(n, radius), 2 * radius);
}

GeneratedShape makeBox(uint64_t faceCount, const Vec3d& size) {
  // Two triangles per square cell, and at least one cell per direction.
  const double cellArea = 4 * (size.x * size.y + size.y * size.z + size.z * size.x) / double(faceCount);
  const double edge = std::sqrt(cellArea);
  const auto cells = [&](double extent) { return static_cast<uint32_t>(std::max(1.0, std::round(extent / edge))); };
  return withUniformDiameter(boxMesh(size, cells(size.x), cells(size.y), cells(size.z)),
                             std::min({size.x, size.y, size.z}));
}

GeneratedShape makeSlab(uint64_t faceCount, double width, double thickness) {
  return makeBox(faceCount, {width, width, thickness});
}

GeneratedShape makeCube(uint64_t faceCount, double edge) { return makeBox(faceCount, {edge, edge, edge}); }

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
