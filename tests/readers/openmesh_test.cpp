#include <doctest/doctest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "reading.h"

using namespace asdfvk;

namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

/// The faces of the file, whether or not they are triangles.
std::vector<std::vector<uint32_t>> inputFaces(const Mesh& mesh) {
  std::vector<std::vector<uint32_t>> faces;
  if (mesh.polygons.isEmpty()) {
    for (const Face& face : mesh.faces) faces.emplace_back(face.begin(), face.end());
    return faces;
  }
  const auto begin = mesh.polygons.corners.begin();
  for (size_t i = 0; i + 1 < mesh.polygons.firstCorner.size(); ++i)
    faces.emplace_back(begin + static_cast<ptrdiff_t>(mesh.polygons.firstCorner[i]),
                       begin + static_cast<ptrdiff_t>(mesh.polygons.firstCorner[i + 1]));
  return faces;
}

/// A face's corners from its lowest vertex on: a half-edge mesh may begin anywhere.
std::vector<uint32_t> fromLowest(std::vector<uint32_t> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

void requireSameAsOpenMesh(const std::string& path) {
  CAPTURE(path);
  PolyMesh theirs;
  REQUIRE(OpenMesh::IO::read_mesh(theirs, path));
  const Mesh ours = readMesh(path);
  const std::vector<std::vector<uint32_t>> faces = inputFaces(ours);
  REQUIRE(ours.vertices.size() == theirs.n_vertices());
  REQUIRE(faces.size() == theirs.n_faces());
  size_t differentCount = 0;
  for (const auto vertex : theirs.vertices()) {
    // OpenMesh's readers keep float32 of what the file says.
    const Vec3d& p = ours.vertices[static_cast<size_t>(vertex.idx())];
    const PolyMesh::Point q = theirs.point(vertex);
    for (size_t axis = 0; axis < 3; ++axis)
      differentCount += static_cast<float>(p[axis]) == static_cast<float>(q[axis]) ? 0 : 1;
  }
  for (const auto face : theirs.faces()) {
    std::vector<uint32_t> corners;
    for (const auto vertex : face.vertices()) corners.push_back(static_cast<uint32_t>(vertex.idx()));
    differentCount += fromLowest(corners) == fromLowest(faces[static_cast<size_t>(face.idx())]) ? 0 : 1;
  }
  CHECK(differentCount == 0);
}

}  // namespace

TEST_CASE("small meshes are read as OpenMesh reads them") {
  PolyMesh mesh;
  std::vector<PolyMesh::VertexHandle> v;
  for (int i = 0; i < 8; ++i) v.push_back(mesh.add_vertex({i & 1, (i >> 1) & 1, 0.125 * (i >> 2)}));
  for (const auto& f :
       std::vector<std::vector<size_t>>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6}, {3, 6, 7}}) {
    std::vector<PolyMesh::VertexHandle> corners;
    for (const size_t i : f) corners.push_back(v[i]);
    mesh.add_face(corners);
  }
  std::string folder = (std::filesystem::temp_directory_path() / "asdfvk-openmesh-XXXXXX").string();
  REQUIRE(::mkdtemp(folder.data()) != nullptr);
  for (const char* name : {"cube.off", "cube.obj", "cube.ply"}) {
    const std::string path = folder + "/" + name;
    REQUIRE(OpenMesh::IO::write_mesh(mesh, path));
    requireSameAsOpenMesh(path);
  }
  using OpenMesh::IO::Options;
  for (const auto flags : {Options::Binary + Options::LSB, Options::Binary + Options::MSB}) {
    const std::string path = folder + "/binary.ply";
    REQUIRE(OpenMesh::IO::write_mesh(mesh, path, Options(flags)));
    requireSameAsOpenMesh(path);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("the real meshes are read as OpenMesh reads them") {
  const char* folder = std::getenv("ASDF_VK_MESH_DIR");
  if (folder == nullptr) {
    MESSAGE("skipped: ASDF_VK_MESH_DIR is not set");
    return;
  }
  // A half-edge mesh refuses the faces of other meshes there, which are non-manifold.
  for (const char* name :
       {"models/horse.ply", "models/armadillo.ply", "models/elephant.obj", "models/cow.off", "models/fertility.off",
        "models/3holes.off", "open/suzanne.obj", "open/teapot.obj", "open/camelhead.off", "defects/blobby_3cc.off"})
    requireSameAsOpenMesh((std::filesystem::path(folder) / name).string());
}

TEST_CASE("every real mesh is read with the face count that its header says") {
  const char* folder = std::getenv("ASDF_VK_MESH_DIR");
  if (folder == nullptr) {
    MESSAGE("skipped: ASDF_VK_MESH_DIR is not set");
    return;
  }
  size_t fileCount = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".off") continue;
    CAPTURE(entry.path().string());
    ++fileCount;
    std::ifstream file(entry.path());
    std::stringstream words;
    for (std::string line; std::getline(file, line) && words.str().size() < 200;)
      if (!line.empty() && line[0] != '#') words << line << '\n';
    std::string keyword;
    size_t vertexCount = 0, faceCount = 0;
    words >> keyword >> vertexCount >> faceCount;
    const Mesh mesh = readMesh(entry.path());
    CHECK(mesh.vertices.size() == vertexCount);
    CHECK(mesh.inputFaceCount() == faceCount);
  }
  CHECK(fileCount > 0);
}
