#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/vec3.h"
#include "generate/analytic_shapes.h"
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

}  // namespace

GeneratedShape makeSphere(uint64_t faceCount, double radius) {
  const auto n = static_cast<uint32_t>(std::max(1.0, std::round(std::sqrt(double(faceCount) / 20))));
  return withUniformDiameter(geodesicMesh(n, radius), 2 * radius);
}

}  // namespace asdfvk
