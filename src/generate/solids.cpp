#include "generate/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "generate/analytic_shapes.h"

namespace asdfvk::solids {
namespace {

void addQuad(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  mesh.faces.push_back({a, b, c});
  mesh.faces.push_back({a, c, d});
}

}  // namespace

Mesh box(const Vec3d& min, const Vec3d& max) {
  Mesh mesh;
  for (uint32_t i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z});
  addQuad(mesh, 0, 4, 6, 2);
  addQuad(mesh, 1, 3, 7, 5);
  addQuad(mesh, 0, 1, 5, 4);
  addQuad(mesh, 2, 6, 7, 3);
  addQuad(mesh, 0, 2, 3, 1);
  addQuad(mesh, 4, 5, 7, 6);
  return mesh;
}

Mesh regularPrism(uint32_t sideCount, double radius, double bottom, double top) {
  Outline outline = arc(0, 0, radius, 0, 360, sideCount);
  outline.pop_back();
  return moved(extruded(std::move(outline), top - bottom), {0, 0, bottom});
}

Mesh tube(uint32_t sideCount, double innerBottom, double innerTop, double outer, double bottom, double top) {
  Mesh mesh;
  const std::array<std::pair<double, double>, 4> profile{
      {{innerBottom, bottom}, {outer, bottom}, {outer, top}, {innerTop, top}}};
  for (uint32_t i = 0; i < sideCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / sideCount;
    for (const auto& [radius, z] : profile)
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  for (uint32_t i = 0; i < sideCount; ++i)
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t here = 4 * i, next = 4 * ((i + 1) % sideCount), other = (k + 1) % 4;
      addQuad(mesh, here + k, next + k, next + other, here + other);
    }
  return mesh;
}

Mesh cone(uint32_t sideCount, double radius, double height) {
  Mesh mesh;
  for (const auto& [x, y] : arc(0, 0, radius, 0, 360, sideCount)) mesh.vertices.push_back({x, y, 0});
  mesh.vertices.back() = {0, 0, height};
  for (uint32_t i = 0; i < sideCount; ++i) mesh.faces.push_back({i, (i + 1) % sideCount, sideCount});
  for (uint32_t i = 1; i + 1 < sideCount; ++i) mesh.faces.push_back({0, i + 1, i});
  return mesh;
}

Mesh ball(const Vec3d& centre, double radius, uint32_t faceCount) {
  return moved(makeSphere(faceCount, radius).mesh, centre);
}

Mesh joined(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& mesh : meshes) {
    const auto first = static_cast<uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.faces) all.faces.push_back({first + a, first + b, first + c});
  }
  return all;
}

Mesh inverted(Mesh mesh) {
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

Mesh moved(Mesh mesh, const Vec3d& shift) {
  for (Vec3d& vertex : mesh.vertices) vertex += shift;
  return mesh;
}

Mesh scaled(Mesh mesh, double factor) {
  for (Vec3d& vertex : mesh.vertices) vertex = vertex * factor;
  return mesh;
}

Mesh separated(const Mesh& mesh) {
  Mesh apart;
  for (const Face& face : mesh.faces) {
    const auto first = static_cast<uint32_t>(apart.vertices.size());
    for (const uint32_t vertex : face) apart.vertices.push_back(mesh.vertices[vertex]);
    apart.faces.push_back({first, first + 1, first + 2});
  }
  return apart;
}

Mesh welded(Mesh mesh) {
  std::map<std::array<double, 3>, uint32_t> vertexAt;
  std::vector<Vec3d> vertices;
  for (Face& face : mesh.faces)
    for (uint32_t& vertex : face) {
      const Vec3d& p = mesh.vertices[vertex];
      const auto [at, isNew] = vertexAt.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(vertices.size()));
      if (isNew) vertices.push_back(p);
      vertex = at->second;
    }
  mesh.vertices = std::move(vertices);
  return mesh;
}

Mesh without(Mesh mesh, size_t first, size_t count) {
  const auto begin = mesh.faces.begin() + static_cast<std::ptrdiff_t>(first);
  mesh.faces.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  return mesh;
}

}  // namespace asdfvk::solids
