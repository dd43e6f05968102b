#pragma once

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk::bench {

/// Fills plain arrays from what an OpenMesh reader finds.
class ArrayImporter : public OpenMesh::IO::BaseImporter {
 public:
  using VertexHandle = OpenMesh::VertexHandle;
  using FaceHandle = OpenMesh::FaceHandle;

  VertexHandle add_vertex(const OpenMesh::Vec3f& p) override {
    vertices.push_back({p[0], p[1], p[2]});
    return VertexHandle(static_cast<int>(vertices.size()) - 1);
  }
  VertexHandle add_vertex(const OpenMesh::Vec3d& p) override {
    vertices.push_back({p[0], p[1], p[2]});
    return VertexHandle(static_cast<int>(vertices.size()) - 1);
  }
  VertexHandle add_vertex() override { return add_vertex(OpenMesh::Vec3d(0, 0, 0)); }
  FaceHandle add_face(const VHandles& corners) override {
    faces.push_back({static_cast<uint32_t>(corners[0].idx()), static_cast<uint32_t>(corners[1].idx()),
                     static_cast<uint32_t>(corners[2].idx())});
    return FaceHandle(static_cast<int>(faces.size()) - 1);
  }
  void reserve(unsigned int vertexCount, unsigned int, unsigned int faceCount) override {
    vertices.reserve(vertexCount);
    faces.reserve(faceCount);
  }
  size_t n_vertices() const override { return vertices.size(); }
  size_t n_faces() const override { return faces.size(); }
  size_t n_edges() const override { return 0; }

  OpenMesh::HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return OpenMesh::HalfedgeHandle(); }
  FaceHandle add_face(OpenMesh::HalfedgeHandle) override { return FaceHandle(); }
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<OpenMesh::Vec3f>&) override {}
  void set_face_texindex(FaceHandle, int) override {}
  void set_point(VertexHandle v, const OpenMesh::Vec3f& p) override {
    vertices[static_cast<size_t>(v.idx())] = {p[0], p[1], p[2]};
  }
  void set_halfedge(VertexHandle, OpenMesh::HalfedgeHandle) override {}
  void set_normal(VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_normal(VertexHandle, const OpenMesh::Vec3d&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec4f&) override {}
  void set_texcoord(VertexHandle, const OpenMesh::Vec2f&) override {}
  void set_status(VertexHandle, const OpenMesh::Attributes::StatusInfo&) override {}
  void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec2f&) override {}
  void set_texcoord(VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec3f&) override {}
  void set_status(OpenMesh::HalfedgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
  void set_status(OpenMesh::EdgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
  void set_normal(FaceHandle, const OpenMesh::Vec3f&) override {}
  void set_normal(FaceHandle, const OpenMesh::Vec3d&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec3f&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec4f&) override {}
  void set_status(FaceHandle, const OpenMesh::Attributes::StatusInfo&) override {}
  void set_next(OpenMesh::HalfedgeHandle, OpenMesh::HalfedgeHandle) override {}
  void set_face(OpenMesh::HalfedgeHandle, FaceHandle) override {}
  void request_face_texcoords2D() override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3f&) override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4f&) override {}
  void add_texture_information(int, std::string) override {}

  std::vector<Vec3d> vertices;
  std::vector<Face> faces;
};

}  // namespace asdfvk::bench
