#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <string>

#include "asdf_vk/files.h"
#include "mesh/coincident_faces.h"
#include "mesh/orientation.h"
#include "mesh/validation.h"
#include "support/real_meshes.h"

using namespace asdfvk;

namespace {

struct Expected {
  uint64_t inputFaceCount;
  size_t componentCount;
  uint64_t boundaryEdgeCount, nonManifoldEdgeCount, zeroAreaFaceCount, duplicateFaceCount;
  size_t invertedComponentCount;
};

// Faces as the files' own headers count them.
const std::map<std::string, Expected> kExpected = {
    {"defects/blobby_3cc.off", {3417, 3, 219, 0, 0, 0, 0}},
    {"defects/degtri_sliding.off", {8, 1, 6, 0, 4, 0, 0}},
    {"defects/quads_to_stitch.off", {8, 2, 20, 0, 0, 0, 0}},
    {"defects/tetra_intersected_by_triangle.off", {5, 2, 3, 0, 0, 0, 1}},
    {"open/camelhead.off", {22704, 1, 56, 0, 0, 0, 0}},
    {"open/decimated-knight.off", {1000, 1, 0, 0, 0, 0, 0}},
    {"open/elephant-with-holes.off", {4463, 1, 1353, 0, 0, 0, 0}},
    {"open/mesh_with_border.off", {1014, 1, 80, 0, 0, 0, 0}},
    {"open/open_cube.off", {10, 1, 4, 0, 0, 0, 0}},
    {"open/plane.off", {1600, 1, 80, 0, 0, 0, 0}},
    {"open/suzanne.obj", {500, 3, 42, 1, 0, 0, 0}},  // One face is there in both windings.
    {"open/teapot.obj", {6320, 19, 1036, 0, 0, 0, 0}},
    {"models/3holes.off", {7200, 1, 0, 0, 0, 0, 0}},
    {"models/armadillo.ply", {86482, 1, 0, 0, 0, 0, 0}},
    {"models/cheburashka.off", {13334, 1, 0, 0, 0, 0, 0}},
    {"models/cow.off", {5520, 1, 0, 0, 0, 0, 0}},
    {"models/elephant.obj", {12064, 1, 0, 0, 0, 0, 0}},
    {"models/fandisk.off", {14454, 1, 0, 0, 0, 0, 0}},
    {"models/fertility.off", {9000, 1, 0, 0, 0, 0, 0}},
    {"models/horse-10k.off", {9998, 1, 0, 0, 0, 0, 0}},
    {"models/horse.ply", {96966, 1, 0, 0, 0, 0, 0}},
};

}  // namespace

TEST_CASE("real meshes have the faces that their files count and the defects that they are known for") {
  const auto folder = test::realMeshFolder();
  if (!folder) return;
  for (const auto& [file, expected] : kExpected) {
    const std::string& name = file;
    CAPTURE(name);
    const Mesh mesh = readMesh(*folder / name);
    CHECK(mesh.inputFaceCount() == expected.inputFaceCount);
    REQUIRE(countFacesWithIndexOutOfRange(mesh) == 0);
    const EdgeSurvey edges = surveyEdges(mesh);
    const MeshDefects defects =
        findDefects(mesh, computeFaceGeometry(mesh), coincidentRepresentatives(mesh, edges), edges);
    CHECK(defects.boundaryEdgeCount == expected.boundaryEdgeCount);
    CHECK(defects.nonManifoldEdgeCount == expected.nonManifoldEdgeCount);
    CHECK(defects.zeroAreaFaceCount == expected.zeroAreaFaceCount);
    CHECK(defects.duplicateFaceCount == expected.duplicateFaceCount);
    const Components components = findComponents(mesh, edges);
    CHECK(components.components.size() == expected.componentCount);
    CHECK(analyseOrientation(mesh, components).invertedComponents.size() == expected.invertedComponentCount);
  }
}
