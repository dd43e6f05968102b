#pragma once

#include <cmath>
#include <cstdint>

#include "core/random.h"
#include "mesh/mesh.h"

namespace asdfvk {

inline void addTriangle(Mesh& mesh, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.faces.push_back({first, first + 1, first + 2});
}

inline Vec3d randomPoint(Random& random) { return {random.real() - 0.5, random.real() - 0.5, random.real() - 0.5}; }

/// Small random triangles in a unit cube.
inline Mesh soup(uint32_t faceCount, uint64_t seed, double size = 0.05) {
  Mesh mesh;
  Random random(seed);
  for (uint32_t i = 0; i < faceCount; ++i) {
    const Vec3d p = randomPoint(random);
    addTriangle(mesh, p + randomPoint(random) * size, p + randomPoint(random) * size, p + randomPoint(random) * size);
  }
  return mesh;
}

/// A wavy sheet of 2 * side^2 faces that share vertices.
inline Mesh sheet(uint32_t side) {
  Mesh mesh;
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x) mesh.vertices.push_back({1.0 * x, 1.0 * y, 3 * std::sin(0.1 * x + 0.07 * y)});
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t v = y * (side + 1) + x;
      mesh.faces.push_back({v, v + 1, v + side + 2});
      mesh.faces.push_back({v, v + side + 2, v + side + 1});
    }
  }
  return mesh;
}

}  // namespace asdfvk
