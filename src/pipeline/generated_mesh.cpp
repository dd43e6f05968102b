#include "pipeline/generated_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asdfvk {
namespace {

/// radiusAt(u, v): radius at angle v in the section that is at angle u around the z axis.
template <typename RadiusAt>
Mesh ringWith(uint32_t longCount, uint32_t shortCount, const RadiusAt& radiusAt) {
  Mesh mesh;
  for (uint32_t i = 0; i < longCount; ++i) {
    for (uint32_t j = 0; j < shortCount; ++j) {
      const double u = 2 * std::numbers::pi * i / longCount, v = 2 * std::numbers::pi * j / shortCount;
      const double radius = radiusAt(u, v);
      const double distance = 1 + radius * std::cos(v);
      mesh.vertices.push_back({distance * std::cos(u), distance * std::sin(u), radius * std::sin(v)});
      const auto at = [&](uint32_t a, uint32_t b) { return (a % longCount) * shortCount + b % shortCount; };
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

double bumpyRadius(double u, double v) { return 0.35 * (1 + 0.25 * std::sin(5 * u) * std::cos(3 * v)); }

}  // namespace

Mesh bumpyTorus(uint32_t longCount, uint32_t shortCount) { return ringWith(longCount, shortCount, bumpyRadius); }

Mesh halfSquareRing() {
  return ringWith(24, 16, [](double u, double v) {
    if (u < std::numbers::pi) return bumpyRadius(u, v);
    return 0.35 / std::max(std::abs(std::cos(v)), std::abs(std::sin(v)));
  });
}

}  // namespace asdfvk
