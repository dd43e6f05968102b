#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "support/require_failure.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

Mesh squareMesh() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  mesh.polygons = {{0, 4}, {0, 1, 2, 3}, {0, 0}};
  return mesh;
}

}  // namespace

TEST_CASE("joined meshes have all faces in their order, with the corners of their own vertices") {
  const Mesh cube = shapes::cube(), tetrahedron = shapes::tetrahedron();
  const std::vector<const Mesh*> meshes{&cube, &tetrahedron};
  const Mesh mesh = joinMeshes(meshes, std::vector<std::string>{"lid", "base"});
  REQUIRE(mesh.faceCount() == 16);
  REQUIRE(mesh.vertices.size() == 12);
  CHECK(mesh.polygons.isEmpty());
  CHECK(mesh.faces[0] == cube.faces[0]);
  for (size_t k = 0; k < 3; ++k)
    CHECK(mesh.vertices[mesh.faces[12][k]] == tetrahedron.vertices[tetrahedron.faces[0][k]]);
  CHECK(mesh.objects == std::vector<NamedFaces>{{0, "lid"}, {12, "base"}});
  CHECK(mesh.statedPartCount == 2);
}

TEST_CASE("polygons and triangles are joined in both orders") {
  const Mesh square = squareMesh(), cube = shapes::cube();
  const std::vector<std::string> names(3);
  const std::vector<const Mesh*> meshes{&cube, &square, &cube};
  const Mesh mesh = joinMeshes(meshes, names);
  REQUIRE(mesh.inputFaceCount() == 25);
  CHECK(mesh.faceCount() == 26);
  CHECK(mesh.polygons.inputFaceOf[11] == 11);
  CHECK(mesh.polygons.inputFaceOf[12] == 12);
  CHECK(mesh.polygons.inputFaceOf[13] == 12);
  CHECK(mesh.polygons.inputFaceOf[25] == 24);
  CHECK(mesh.polygons.firstCorner[13] - mesh.polygons.firstCorner[12] == 4);
  CHECK(mesh.polygons.corners[mesh.polygons.firstCorner[12] + 3] == 11);
  CHECK(mesh.polygons.corners.size() == mesh.polygons.firstCorner.back());
  CHECK(mesh.faces[12] == Face{8, 9, 10});
  CHECK(mesh.objects.empty());
}

TEST_CASE("names of objects keep their faces") {
  Mesh first = shapes::cube(), second = shapes::cube();
  second.objects = {{4, "arm"}, {9, ""}};
  const std::vector<const Mesh*> meshes{&first, &second};
  CHECK(joinMeshes(meshes, std::vector<std::string>{"", "robot"}).objects ==
        std::vector<NamedFaces>{{12, "robot"}, {16, "arm"}, {21, ""}});
}

TEST_CASE("facts about the files are joined, and units must agree") {
  Mesh first = shapes::cube(), second = shapes::cube();
  first.unit = "mm";
  first.skipped = {"2 points"};
  second.chordError = 0.1;
  second.negativeVolumeCount = 1;
  second.float32Step = 0.5;
  const std::vector<const Mesh*> meshes{&first, &second};
  const std::vector<std::string> names(2);
  const Mesh mesh = joinMeshes(meshes, names);
  CHECK(mesh.unit == "mm");
  CHECK(mesh.skipped == std::vector<std::string>{"2 points"});
  CHECK(mesh.chordError == 0.1);
  CHECK(mesh.negativeVolumeCount == 1);
  CHECK(mesh.float32Step == 0.5);
  second.unit = "m";
  test::requireFailure([&] { (void)joinMeshes(meshes, names); }, ErrorCode::UnitsDiffer, "another has the unit m;");
  first.unit = "";
  test::requireFailure([&] { (void)joinMeshes(meshes, names); }, ErrorCode::UnitsDiffer, "states no unit");
  test::requireFailure([&] { (void)joinMeshes(meshes, std::vector<std::string>(1)); }, ErrorCode::ArraySize, "name");
}
