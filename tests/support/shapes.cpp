#include "support/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/random.h"

namespace asdfvk::shapes {
namespace {

Mesh icosahedron() {
  const double g = std::numbers::phi;
  Mesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

Mesh refined(const Mesh& mesh) {
  Mesh fine;
  fine.vertices = mesh.vertices;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [entry, isNew] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(fine.vertices.size()));
    if (isNew) fine.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) * 0.5);
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.faces) {
    const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

// Vertices of sides are welded by their exact coordinates, which all come from the same sums.
class Welder {
 public:
  explicit Welder(Mesh& mesh) : mesh_(mesh) {}

  uint32_t vertex(const Vec3d& p) {
    const auto [entry, isNew] =
        indices_.try_emplace(std::array{p.x, p.y, p.z}, static_cast<uint32_t>(mesh_.vertices.size()));
    if (isNew) mesh_.vertices.push_back(p);
    return entry->second;
  }
  void quad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const uint32_t i = vertex(a), j = vertex(b), k = vertex(c), l = vertex(d);
    mesh_.faces.insert(mesh_.faces.end(), {{i, j, k}, {i, k, l}});
  }

 private:
  Mesh& mesh_;
  std::map<std::array<double, 3>, uint32_t> indices_;
};

Mesh boxWithSides(const Vec3d& size, uint32_t side, bool hasTop) {
  Mesh mesh;
  Welder welder(mesh);
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      if (axis == 2 && sign > 0 && !hasTop) continue;
      const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto corner = [&](uint32_t i, uint32_t j) {
        Vec3d p;
        p[axis] = 0.5 * sign * size[axis];
        p[u] = size[u] * (static_cast<double>(i) / side - 0.5);
        p[v] = size[v] * (static_cast<double>(j) / side - 0.5);
        return p;
      };
      for (uint32_t i = 0; i < side; ++i) {
        for (uint32_t j = 0; j < side; ++j) {
          if (sign > 0)
            welder.quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
          else
            welder.quad(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j));
        }
      }
    }
  }
  return mesh;
}

Mesh onSphere(Mesh mesh, uint32_t levels, double radius) {
  for (uint32_t i = 0; i < levels; ++i) mesh = refined(mesh);
  for (Vec3d& v : mesh.vertices) v = v * (radius / length(v));
  return mesh;
}

}  // namespace

Mesh icosphere(uint32_t levels, double radius) { return onSphere(icosahedron(), levels, radius); }

Mesh sphere(uint32_t levels) {
  Mesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
            {}};
  return onSphere(std::move(mesh), levels, 1);
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

Mesh doubledCube() {
  Mesh mesh = cube();
  for (size_t side = 0; side < 6; ++side) {
    const auto [a, b, c] = mesh.faces[2 * side];
    const uint32_t d = mesh.faces[2 * side + 1][2];
    mesh.faces.insert(mesh.faces.end(), {{a, b, d}, {b, c, d}});
  }
  return mesh;
}

Mesh box(const Vec3d& size, uint32_t side) { return boxWithSides(size, side, true); }

Mesh openBox(const Vec3d& size, uint32_t side) { return boxWithSides(size, side, false); }

Mesh cylinder(double radius, double height, uint32_t sideCount, uint32_t ringCount) {
  Mesh mesh;
  for (uint32_t ring = 0; ring <= ringCount; ++ring) {
    for (uint32_t i = 0; i < sideCount; ++i) {
      const double a = 2 * std::numbers::pi * i / sideCount;
      mesh.vertices.push_back(
          {radius * std::cos(a), radius * std::sin(a), height * (static_cast<double>(ring) / ringCount - 0.5)});
    }
  }
  const auto bottom = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0, -0.5 * height}, {0, 0, 0.5 * height}});
  for (uint32_t i = 0; i < sideCount; ++i) {
    const uint32_t next = (i + 1) % sideCount, top = ringCount * sideCount;
    for (uint32_t ring = 0; ring < ringCount; ++ring) {
      const uint32_t low = ring * sideCount, high = low + sideCount;
      mesh.faces.insert(mesh.faces.end(), {{low + i, low + next, high + next}, {low + i, high + next, high + i}});
    }
    mesh.faces.insert(mesh.faces.end(), {{bottom, next, i}, {bottom + 1, top + i, top + next}});
  }
  return mesh;
}

Mesh torus(double majorRadius, double minorRadius, uint32_t majorCount, uint32_t minorCount) {
  Mesh mesh;
  for (uint32_t i = 0; i < majorCount; ++i) {
    for (uint32_t j = 0; j < minorCount; ++j) {
      const double u = 2 * std::numbers::pi * i / majorCount, v = 2 * std::numbers::pi * j / minorCount;
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

Mesh book(uint32_t pageCount) {
  Mesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}, {}};
  for (uint32_t page = 0; page < pageCount; ++page) {
    const double angle = 2 * std::numbers::pi * page / pageCount;
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
    const double angle = std::numbers::pi * i / faceCount;
    mesh.vertices[firstOnRim + i] = {std::cos(angle), std::sin(angle), 0};
  }
  for (uint32_t i = 0; i < faceCount; ++i) mesh.faces.push_back({apex, firstOnRim + i, firstOnRim + i + 1});
  return mesh;
}

Mesh randomFaces(uint32_t vertexCount, uint32_t faceCount, uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (uint32_t i = 0; i < vertexCount; ++i) mesh.vertices.push_back({random.real(), random.real(), random.real()});
  for (uint32_t i = 0; i < faceCount; ++i) {
    const uint32_t a = random.index(vertexCount), b = random.index(vertexCount), c = random.index(vertexCount);
    mesh.faces.push_back({a, b, c});
  }
  return mesh;
}

Mesh soup(uint32_t faceCount, uint64_t seed) {
  Mesh mesh;
  Random random(seed);
  for (uint32_t f = 0; f < faceCount; ++f) {
    const auto point = [&] { return Vec3d{random.real() - 0.5, random.real() - 0.5, random.real() - 0.5}; };
    const Vec3d centre = point();
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(centre + point() * 0.4);
    mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return mesh;
}

Mesh shell(double outerRadius, double innerRadius) {
  return joined(icosphere(2, outerRadius), inverted(icosphere(2, innerRadius)));
}

Mesh boxesWithSharedEdge() {
  const Mesh two = joined(box({1, 1, 1}, 2), scaledAndShifted(box({1, 1, 1}, 2), 1, {1, 1, 0}));
  Mesh mesh;
  Welder welder(mesh);
  for (const auto& [a, b, c] : two.faces)
    mesh.faces.push_back(
        {welder.vertex(two.vertices[a]), welder.vertex(two.vertices[b]), welder.vertex(two.vertices[c])});
  return mesh;
}

Mesh jittered(Mesh mesh, double amount, uint64_t seed) {
  Random random(seed);
  for (Vec3d& v : mesh.vertices)
    v += Vec3d{random.real() - 0.5, random.real() - 0.5, random.real() - 0.5} * (2 * amount);
  return mesh;
}

Mesh scaledAndShifted(Mesh mesh, double scale, const Vec3d& shift) {
  for (Vec3d& v : mesh.vertices) v = v * scale + shift;
  return mesh;
}

Mesh inverted(Mesh mesh) {
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

Mesh joined(Mesh mesh, const Mesh& other, const Vec3d& shift) {
  const auto offset = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& vertex : other.vertices) mesh.vertices.push_back(vertex + shift);
  for (const auto& [a, b, c] : other.faces) mesh.faces.push_back({a + offset, b + offset, c + offset});
  return mesh;
}

}  // namespace asdfvk::shapes
