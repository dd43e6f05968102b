// Compares the speed of the binary PLY readers of asdf-vk and of OpenMesh. Both read into plain arrays, in turns.
#include <fmt/format.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "process/temporary_folder.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

/// Receives the mesh of an OpenMesh reader as plain arrays. Ignores attributes.
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

void writeSheet(const std::filesystem::path& path, uint32_t faceCount) {
  uint32_t side = 1;
  while (2 * uint64_t{side} * side < faceCount) ++side;
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      (side + 1) * (side + 1), 2 * side * side);
  const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x)
      append(std::array{static_cast<float>(x), static_cast<float>(y), static_cast<float>((x * y) % 17)});
  const auto appendFace = [&](const Face& face) {
    append(uint8_t{3});
    append(face);
  };
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
      appendFace({a, b, d});
      appendFace({a, d, c});
    }
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void compare(const std::filesystem::path& path, uint32_t roundCount, const RunControl& control) {
  std::vector<double> seconds, openMeshSeconds;
  size_t vertexCount = 0, faceCount = 0;
  for (uint32_t round = 0; round <= roundCount; ++round) {
    const Stopwatch watch;
    const Mesh mesh = readMesh(path);
    const double ours = watch.seconds();
    ArrayImporter importer;
    OpenMesh::IO::Options options;
    const Stopwatch openMeshWatch;
    const bool isRead = OpenMesh::IO::PLYReader().read(path.string(), importer, options);
    const double theirs = openMeshWatch.seconds();
    if (!isRead || importer.vertices != mesh.vertices || importer.faces != mesh.faces)
      throw std::runtime_error(path.string() + ": OpenMesh reads a different mesh");
    vertexCount = mesh.vertices.size(), faceCount = mesh.faces.size();
    control.checkpoint(0);
    if (round == 0) continue;  // The first round is a warm-up.
    seconds.push_back(ours);
    openMeshSeconds.push_back(theirs);
  }
  writeOutput(fmt::format(
      "{}: {} vertices, {} faces; seconds: median ± median absolute deviation of {} rounds\n"
      "asdf-vk   {}\nOpenMesh  {}\nOpenMesh / asdf-vk  {}\n",
      path.string(), groupDigits(vertexCount), groupDigits(faceCount), roundCount, toText(dispersionOf(seconds), 3),
      toText(dispersionOf(openMeshSeconds), 3), toText(ratioOf(openMeshSeconds, seconds), 2)));
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-read-ply", "Times the binary PLY readers of asdf-vk and of OpenMesh, in turns.");
  std::vector<std::string> meshes;
  uint32_t faceCount = 6'000'000, roundCount = 7;
  program.addOptionalMeshes(meshes, "a generated height field");
  program.add("--faces", faceCount, "Faces of the generated mesh", {2, 100'000'000});
  program.add("--runs", roundCount, "Rounds, after one for warm-up", {1, 1000});
  return program.run(argc, argv, [&](const RunControl& control) {
    for (const std::string& mesh : meshes) compare(mesh, roundCount, control);
    if (!meshes.empty()) return;
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "sheet.ply";
    writeSheet(path, faceCount);
    compare(path, roundCount, control);
  });
}
