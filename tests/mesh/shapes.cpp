#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/random.h"

namespace shapes {

using asdfvk::Face;
using asdfvk::Mesh;
using asdfvk::Vec3d;

namespace {
constexpr double kPi = std::numbers::pi;
}

Mesh tetrahedron() {
  return {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
}

Mesh cube() {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back({corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0});
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Mesh grid(uint32_t n) {
  Mesh mesh;
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) mesh.vertices.push_back({double(x), double(y), 0});
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({b, d, c});
    }
  }
  return mesh;
}

Mesh torus(double majorRadius, double minorRadius, uint32_t majorCount, uint32_t minorCount) {
  Mesh mesh;
  for (uint32_t i = 0; i < majorCount; ++i) {
    for (uint32_t j = 0; j < minorCount; ++j) {
      const double u = 2 * kPi * i / majorCount, v = 2 * kPi * j / minorCount;
      const double r = majorRadius + minorRadius * std::cos(v);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), minorRadius * std::sin(v)});
    }
  }
  for (uint32_t i = 0; i < majorCount; ++i) {
    for (uint32_t j = 0; j < minorCount; ++j) {
      const uint32_t nextI = (i + 1) % majorCount, nextJ = (j + 1) % minorCount;
      const uint32_t a = i * minorCount + j, b = nextI * minorCount + j, c = nextI * minorCount + nextJ,
                     d = i * minorCount + nextJ;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  }
  return mesh;
}

Mesh sphere(uint32_t levels) {
  Mesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
            {}};
  for (uint32_t level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), uint32_t(mesh.vertices.size()));
      if (isNew) {
        const Vec3d sum = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.push_back(sum / length(sum));
      }
      return entry->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : mesh.faces) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.faces = std::move(finer);
  }
  return mesh;
}

Mesh book(uint32_t pageCount) {
  Mesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}, {}};
  for (uint32_t page = 0; page < pageCount; ++page) {
    const double angle = 2 * kPi * page / pageCount;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0.5});
    mesh.faces.push_back({0, 1, page + 2});
  }
  return mesh;
}

Mesh fan(uint32_t faceCount, bool apexFirst) {
  Mesh mesh;
  const uint32_t apex = apexFirst ? 0 : faceCount + 1, firstOnRim = apexFirst ? 1 : 0;
  mesh.vertices.resize(faceCount + 2);
  for (uint32_t i = 0; i <= faceCount; ++i) {
    const double angle = kPi * i / faceCount;
    mesh.vertices[firstOnRim + i] = {std::cos(angle), std::sin(angle), 0};
  }
  for (uint32_t i = 0; i < faceCount; ++i) mesh.faces.push_back({apex, firstOnRim + i, firstOnRim + i + 1});
  return mesh;
}

Mesh soup(uint32_t vertexCount, uint32_t faceCount, uint64_t seed) {
  asdfvk::Random random(seed);
  Mesh mesh;
  for (uint32_t i = 0; i < vertexCount; ++i) mesh.vertices.push_back({random.real(), random.real(), random.real()});
  for (uint32_t i = 0; i < faceCount; ++i) {
    const uint32_t a = random.index(vertexCount), b = random.index(vertexCount), c = random.index(vertexCount);
    mesh.faces.push_back({a, b, c});
  }
  return mesh;
}

Mesh placed(Mesh mesh, double scale, const Vec3d& shift) {
  for (Vec3d& vertex : mesh.vertices) vertex = vertex * scale + shift;
  return mesh;
}

Mesh inverted(Mesh mesh) {
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

Mesh together(Mesh mesh, const Mesh& other) {
  const uint32_t offset = uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.faces) mesh.faces.push_back({a + offset, b + offset, c + offset});
  return mesh;
}

}  // namespace shapes
