#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

#include "openmesh_reading.h"

using namespace asdfvk;
using test::PolyMesh;
using test::requireSameAsOpenMesh;

TEST_CASE("small meshes agree with OpenMesh") {
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
