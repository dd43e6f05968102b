#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "core/check.h"
#include "mesh/mesh.h"

/// Compute on an OpenMesh triangle mesh in memory, for example:
///
///   asdfvk::computeOnOpenMesh(halfEdgeMesh, [&](asdfvk::Mesh m) { return session.compute(m, options).sdf; });
///   double value = OpenMesh::getProperty<OpenMesh::FaceHandle, double>(halfEdgeMesh, "sdf")[faceHandle];
namespace asdfvk {

/// The same vertices and faces, by handle index. Faces marked as deleted are refused with CheckFailure: call
/// garbage_collection() before, which renumbers the handles.
template <typename HalfEdgeMesh>
[[nodiscard]] Mesh fromOpenMesh(const HalfEdgeMesh& source) {
  Mesh mesh;
  mesh.vertices.reserve(source.n_vertices());
  for (size_t i = 0; i < source.n_vertices(); ++i) {
    const auto& p = source.point(OpenMesh::VertexHandle(static_cast<int>(i)));
    mesh.vertices.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
  }
  mesh.faces.reserve(source.n_faces());
  for (size_t i = 0; i < source.n_faces(); ++i) {
    const OpenMesh::FaceHandle handle(static_cast<int>(i));
    ASDFVK_CHECK(!source.has_face_status() || !source.status(handle).deleted());
    Face face{};
    size_t corner = 0;
    for (auto vertex = source.cfv_iter(handle); vertex.is_valid(); ++vertex, ++corner) {
      ASDFVK_CHECK_OP(corner, <, face.size());
      face[corner] = static_cast<uint32_t>(vertex->idx());
    }
    ASDFVK_CHECK_OP(corner, ==, face.size());
    mesh.faces.push_back(face);
  }
  return mesh;
}

/// Leaves one value per face, by handle index, as the mesh's face property of type double called `name`; makes the
/// property where it is missing. values: n_faces().
template <typename HalfEdgeMesh>
void writeFaceProperty(HalfEdgeMesh& target, std::span<const double> values, const std::string& name = "sdf") {
  ASDFVK_CHECK_OP(values.size(), ==, target.n_faces());
  auto property = OpenMesh::getOrMakeProperty<OpenMesh::FaceHandle, double>(target, name.c_str());
  for (size_t i = 0; i < values.size(); ++i) property[OpenMesh::FaceHandle(static_cast<int>(i))] = values[i];
}

/// Leaves compute(mesh), a range of one double per face, as the face property `name`.
template <typename HalfEdgeMesh, typename Compute>
void computeOnOpenMesh(HalfEdgeMesh& mesh, Compute&& compute, const std::string& name = "sdf") {
  const auto values = std::forward<Compute>(compute)(fromOpenMesh(std::as_const(mesh)));
  writeFaceProperty(mesh, values, name);
}

}  // namespace asdfvk
