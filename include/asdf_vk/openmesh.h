#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/mesh.h"

/// Computes on an OpenMesh triangle mesh in memory, for example:
///
///   asdfvk::computeOnOpenMesh(halfEdgeMesh, [&](const asdfvk::Mesh& mesh) { return session.compute(mesh).sdf(); });
///   double value = OpenMesh::getProperty<OpenMesh::FaceHandle, double>(halfEdgeMesh, "sdf")[faceHandle];
namespace asdfvk {

/// Returns a mesh with the vertices and faces of `source`, in the order of their handle indices. Throws
/// Error{OptionConflict} if a face is not a triangle or is marked as deleted. garbage_collection() removes deleted
/// faces and renumbers the handles.
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
    if (source.has_face_status() && source.status(handle).deleted())
      throw Error(ErrorCode::OptionConflict, "the OpenMesh mesh has deleted faces; call garbage_collection() first");
    Face face{};
    size_t corner = 0;
    for (auto vertex = source.cfv_iter(handle); vertex.is_valid(); ++vertex, ++corner)
      if (corner < face.size()) face[corner] = static_cast<uint32_t>(vertex->idx());
    if (corner != face.size()) throw Error(ErrorCode::OptionConflict, "a face of the OpenMesh mesh is not a triangle");
    mesh.faces.push_back(face);
  }
  return mesh;
}

/// Stores one value per face in the face property `name` of type double. A missing property is created. values:
/// n_faces() numbers, in the order of the handle indices. Throws Error{ArraySize}.
template <typename HalfEdgeMesh>
void writeFaceProperty(HalfEdgeMesh& target, std::span<const double> values, const std::string& name = "sdf") {
  if (values.size() != target.n_faces())
    throw Error(ErrorCode::ArraySize, "the number of values differs from the number of faces of the OpenMesh mesh");
  auto property = OpenMesh::getOrMakeProperty<OpenMesh::FaceHandle, double>(target, name.c_str());
  for (size_t i = 0; i < values.size(); ++i) property[OpenMesh::FaceHandle(static_cast<int>(i))] = values[i];
}

/// Stores the result of compute(mesh) in a face property. compute: takes a Mesh and returns one double per face.
template <typename HalfEdgeMesh, typename Compute>
void computeOnOpenMesh(HalfEdgeMesh& mesh, Compute&& compute, const std::string& name = "sdf") {
  const auto values = std::forward<Compute>(compute)(fromOpenMesh(std::as_const(mesh)));
  writeFaceProperty(mesh, values, name);
}

}  // namespace asdfvk
