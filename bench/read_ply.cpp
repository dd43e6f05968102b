// Reads a binary PLY with our reader and with OpenMesh's into plain arrays, turn by turn in one run, and prints the
// median and the spread of each. Without a file it writes a float PLY of 3 million vertices and 6 million faces to
// read.
#include <fmt/format.h>
#include <unistd.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/stopwatch.h"
#include "mesh/mesh_reader.h"

namespace {

using asdfvk::Face;
using asdfvk::Mesh;
using asdfvk::Stopwatch;
using asdfvk::Vec3d;

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

/// A wavy sheet of about `faceCount` triangles in float32.
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

void printRow(const char* name, std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  fmt::print("{:<10} median {:.3f} s, {:.3f} to {:.3f} s over {} runs\n", name, seconds[seconds.size() / 2],
             seconds.front(), seconds.back(), seconds.size());
}

}  // namespace

int main(int argumentCount, char** arguments) {
  const bool hasFile = argumentCount > 1;
  const std::filesystem::path path =
      hasFile ? std::filesystem::path(arguments[1])
              : std::filesystem::temp_directory_path() / fmt::format("asdfvk-read-ply-{}.ply", ::getpid());
  if (!hasFile) writeSheet(path, 6'000'000);
  constexpr int kRunCount = 7;
  std::vector<double> ourSeconds, openMeshSeconds;
  bool areEqual = true;
  Mesh mesh;
  for (int run = -1; run < kRunCount; ++run) {  // Run -1 warms up.
    mesh = {};
    const Stopwatch ourWatch;
    mesh = asdfvk::readMesh(path);
    const double ours = ourWatch.seconds();
    ArrayImporter importer;
    OpenMesh::IO::Options options;
    const Stopwatch openMeshWatch;
    const bool isRead = OpenMesh::IO::PLYReader().read(path.string(), importer, options);
    const double theirs = openMeshWatch.seconds();
    areEqual = areEqual && isRead && importer.vertices == mesh.vertices && importer.faces == mesh.faces;
    if (run < 0) continue;
    ourSeconds.push_back(ours);
    openMeshSeconds.push_back(theirs);
  }
  if (!hasFile) std::filesystem::remove(path);
  fmt::print("{} vertices, {} faces, binary PLY\n", mesh.vertices.size(), mesh.faces.size());
  printRow("asdf-vk", ourSeconds);
  printRow("OpenMesh", openMeshSeconds);
  if (!areEqual) fmt::print("the two readers differ\n");
  return areEqual ? 0 : 1;
}
