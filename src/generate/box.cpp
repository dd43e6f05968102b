#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "generate/analytic_shapes.h"
#include "io/corner_welder.h"

namespace asdfvk {
namespace {

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

}  // namespace

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

}  // namespace asdfvk
