#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "core/vec3.h"
#include "generate/analytic_shapes.h"

namespace asdfvk {
namespace {

struct Icosahedron {
  std::array<Vec3d, 12> vertices;                 ///< On the unit sphere.
  std::array<std::array<uint32_t, 3>, 20> faces;  ///< Counter-clockwise seen from outside.
};

[[nodiscard]] Icosahedron unitIcosahedron() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const double norm = std::sqrt(1 + golden * golden);
  const double a = 1 / norm, b = golden / norm;
  return {{{{-a, b, 0},
            {a, b, 0},
            {-a, -b, 0},
            {a, -b, 0},
            {0, -a, b},
            {0, a, b},
            {0, -a, -b},
            {0, a, -b},
            {b, 0, -a},
            {b, 0, a},
            {-b, 0, -a},
            {-b, 0, a}}},
          {{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
            {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
            {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}}};
}

/// The vertices of an icosahedron with edges in n parts: corners, then those on edges, then those inside of sides.
class GeodesicGrid {
 public:
  GeodesicGrid(uint32_t n, double radius) : n_(n), radius_(radius) {
    for (const Vec3d& corner : icosahedron_.vertices) addVertex(corner);
    for (const auto& side : icosahedron_.faces) {
      for (size_t e = 0; e < 3; ++e) addEdge(side[e], side[(e + 1) % 3]);
    }
    for (const auto& side : icosahedron_.faces) addSide(side);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void addVertex(const Vec3d& p) { mesh_.vertices.push_back(p * (radius_ / length(p))); }

  void addEdge(uint32_t from, uint32_t to) {
    if (from > to) std::swap(from, to);
    if (!firstOnEdge_.emplace(std::pair(from, to), static_cast<uint32_t>(mesh_.vertices.size())).second) return;
    const Vec3d &a = icosahedron_.vertices[from], &b = icosahedron_.vertices[to];
    for (uint32_t i = 1; i < n_; ++i) addVertex(a * double(n_ - i) + b * double(i));
  }

  [[nodiscard]] uint32_t onEdge(uint32_t from, uint32_t to, uint32_t step) const {
    if (step == 0) return from;
    if (step == n_) return to;
    if (from > to) return firstOnEdge_.at({to, from}) + (n_ - step) - 1;
    return firstOnEdge_.at({from, to}) + step - 1;
  }

  // Row i runs from edge (0, 1) to edge (0, 2) of the side, with i + 1 vertices.
  void addSide(const std::array<uint32_t, 3>& side) {
    const auto [c0, c1, c2] = side;
    const Vec3d &a = icosahedron_.vertices[c0], &b = icosahedron_.vertices[c1], &c = icosahedron_.vertices[c2];
    std::vector<uint32_t> above{c0}, row;
    for (uint32_t i = 1; i <= n_; ++i) {
      row.clear();
      for (uint32_t j = 0; j <= i; ++j) {
        if (i == n_) {
          row.push_back(onEdge(c1, c2, j));
        } else if (j == 0) {
          row.push_back(onEdge(c0, c1, i));
        } else if (j == i) {
          row.push_back(onEdge(c0, c2, i));
        } else {
          row.push_back(static_cast<uint32_t>(mesh_.vertices.size()));
          addVertex(a * double(n_ - i) + b * double(i - j) + c * double(j));
        }
      }
      for (uint32_t j = 0; j < i; ++j) {
        mesh_.faces.push_back({above[j], row[j], row[j + 1]});
        if (j + 1 < i) mesh_.faces.push_back({above[j], row[j + 1], above[j + 1]});
      }
      std::swap(above, row);
    }
  }

  Icosahedron icosahedron_ = unitIcosahedron();
  uint32_t n_;
  double radius_;
  Mesh mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> firstOnEdge_;
};

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

HalfEdgeMesh halfEdgeIcosahedron() {
  HalfEdgeMesh halfEdges;
  const Icosahedron icosahedron = unitIcosahedron();
  std::array<HalfEdgeMesh::VertexHandle, 12> handles;
  for (size_t v = 0; v < handles.size(); ++v) {
    const Vec3d& p = icosahedron.vertices[v];
    handles[v] = halfEdges.add_vertex({p.x, p.y, p.z});
  }
  for (const auto& [a, b, c] : icosahedron.faces) halfEdges.add_face(handles[a], handles[b], handles[c]);
  return halfEdges;
}

Mesh plainArrays(const HalfEdgeMesh& halfEdges) {
  Mesh mesh;
  mesh.vertices.reserve(halfEdges.n_vertices());
  mesh.faces.reserve(halfEdges.n_faces());
  for (const auto vertex : halfEdges.vertices()) {
    const OpenMesh::Vec3d& p = halfEdges.point(vertex);
    mesh.vertices.push_back({p[0], p[1], p[2]});
  }
  for (const auto face : halfEdges.faces()) {
    Face corners{};
    size_t corner = 0;
    for (const auto vertex : face.vertices()) corners[corner++] = static_cast<uint32_t>(vertex.idx());
    mesh.faces.push_back(corners);
  }
  return mesh;
}

}  // namespace

GeneratedShape makeSphere(uint64_t faceCount, double radius) {
  const auto n = static_cast<uint32_t>(std::max(1.0, std::round(std::sqrt(double(faceCount) / 20))));
  return withUniformDiameter(GeodesicGrid(n, radius).take(), 2 * radius);
}

GeneratedShape makeIcosphere(uint64_t faceCount) {
  const double steps = std::log2(double(faceCount) / 20) / 2;
  const int stepCount = static_cast<int>(std::max(0.0, std::round(steps)));
  HalfEdgeMesh halfEdges = halfEdgeIcosahedron();
  OpenMesh::Subdivider::Uniform::LoopT<HalfEdgeMesh, double> loop;
  loop.attach(halfEdges);
  for (int step = 0; step < stepCount; ++step) {
    loop(1);
    for (const auto vertex : halfEdges.vertices()) {
      const OpenMesh::Vec3d p = halfEdges.point(vertex);
      halfEdges.set_point(vertex, p / p.norm());
    }
  }
  loop.detach();
  return withUniformDiameter(plainArrays(halfEdges), 2);
}

}  // namespace asdfvk
