#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "asdf_vk/openmesh.h"
#include "core/vec3.h"
#include "generate/analytic_shapes.h"
#include "io/corner_welder.h"

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

}  // namespace

GeneratedShape makeSphere(uint64_t faceCount, double radius) {
  const auto n = static_cast<uint32_t>(std::max(1.0, std::round(std::sqrt(double(faceCount) / 20))));
  return withUniformDiameter(geodesicMesh(n, radius), 2 * radius);
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
  return withUniformDiameter(fromOpenMesh(halfEdges), 2);
}

}  // namespace asdfvk
