#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "openmesh_reading.h"
#include "support/real_meshes.h"

using namespace asdfvk;
using test::requireSameAsOpenMesh;

TEST_CASE("the real meshes agree with OpenMesh") {
  const auto folder = test::realMeshFolder();
  if (!folder) return;
  // The other meshes have non-manifold faces, which a half-edge mesh rejects.
  for (const char* name :
       {"models/horse.ply", "models/armadillo.ply", "models/elephant.obj", "models/cow.off", "models/fertility.off",
        "models/3holes.off", "open/suzanne.obj", "open/teapot.obj", "open/camelhead.off", "defects/blobby_3cc.off"})
    requireSameAsOpenMesh((*folder / name).string());
}

TEST_CASE("every real mesh has the face count of its header") {
  const auto folder = test::realMeshFolder();
  if (!folder) return;
  size_t fileCount = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
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
