#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "asdf_vk/openmesh.h"
#include "generate/analytic_shapes.h"
#include "generate/icosahedron.h"

namespace asdfvk {
namespace {

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
