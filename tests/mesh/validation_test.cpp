#include "mesh/validation.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "describe/warnings.h"
#include "mesh/coincident_faces.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

MeshDefects defectsOf(const Mesh& mesh) {
  const EdgeSurvey edges = surveyEdges(mesh);
  return findDefects(mesh, computeFaceGeometry(mesh), coincidentRepresentatives(mesh, edges), edges);
}

std::vector<std::string> sentencesOf(const MeshDefects& defects, bool isOfPolygons) {
  std::vector<std::string> sentences;
  for (const Warning& warning : warningsOf(defects, isOfPolygons)) sentences.push_back(warning.message);
  return sentences;
}

std::vector<std::string> sentencesOf(const Mesh& mesh) {
  return sentencesOf(defectsOf(mesh), !mesh.polygons.isEmpty());
}

}  // namespace

TEST_CASE("clean closed meshes and the empty mesh have no defect") {
  CHECK(sentencesOf({}).empty());
  CHECK(sentencesOf(shapes::tetrahedron()).empty());
  CHECK(sentencesOf(shapes::cube()).empty());
  CHECK(sentencesOf(shapes::inverted(shapes::sphere(3))).empty());
  CHECK(sentencesOf(shapes::torus(3, 1, 12, 8)).empty());
}

TEST_CASE("one face is open on all sides") {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  CHECK(defectsOf(mesh).boundaryEdgeCount == 3);
  CHECK(sentencesOf(mesh) ==
        std::vector<std::string>{"3 edges have only one face: the surface is open there and rays can escape"});
}

TEST_CASE("faces of zero area are counted, with and without a repeated vertex") {
  Mesh mesh = shapes::cube();
  mesh.vertices.push_back({0, -1, -1});  // On the edge from 0 to 1.
  mesh.faces.push_back({0, 1, 8});
  mesh.faces.push_back({0, 0, 1});
  const MeshDefects defects = defectsOf(mesh);
  CHECK(defects.zeroAreaFaceCount == 2);
  CHECK(sentencesOf(defects, false).front() == "2 faces have zero area: they cast no rays");
  CHECK(defects.nonManifoldEdgeCount == 1);  // The face in line is a third one on the edge, the collapsed one is none.
  CHECK(defects.boundaryEdgeCount == 2);
}

TEST_CASE("duplicate faces are counted beyond the first") {
  Mesh mesh = shapes::cube();
  mesh.faces.push_back({3, 0, 2});
  mesh.faces.push_back({2, 3, 0});
  const MeshDefects defects = defectsOf(mesh);
  CHECK(defects.duplicateFaceCount == 2);
  CHECK(defects.nonManifoldEdgeCount == 3);
  CHECK(defects.boundaryEdgeCount == 0);
}

TEST_CASE("an edge of three faces is non-manifold, its pages are open") {
  const MeshDefects defects = defectsOf(shapes::book(3));
  CHECK(defects.nonManifoldEdgeCount == 1);
  CHECK(defects.boundaryEdgeCount == 6);
  CHECK(defects.inconsistentEdgeCount == 0);
  CHECK(sentencesOf(defects, false).front() ==
        "1 edge has more than two faces: two solids touch there, or inside and outside are not defined");
}

TEST_CASE("a face wound against its neighbours has three inconsistent edges") {
  Mesh mesh = shapes::cube();
  std::swap(mesh.faces[4][1], mesh.faces[4][2]);
  const MeshDefects defects = defectsOf(mesh);
  CHECK(defects.inconsistentEdgeCount == 3);
  CHECK(defects.boundaryEdgeCount == 0);
  CHECK(defects.nonManifoldEdgeCount == 0);
}

TEST_CASE("vertices that no triangle uses are counted") {
  Mesh mesh = shapes::cube();
  mesh.vertices.push_back({0, 0, 0});
  CHECK(defectsOf(mesh).unreferencedVertexCount == 1);
  CHECK(sentencesOf(mesh) == std::vector<std::string>{"1 vertex belongs to no triangle: it is ignored"});
}

TEST_CASE("NaN and infinite coordinates are counted by vertex and face, the hole they leave by edge") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mesh mesh = shapes::tetrahedron();
    mesh.vertices[2].z = bad;
    const MeshDefects defects = defectsOf(mesh);
    CHECK(defects.nonFiniteVertexCount == 1);
    CHECK(defects.nonFiniteFaceCount == 3);
    CHECK(defects.zeroAreaFaceCount == 0);
    CHECK(defects.boundaryEdgeCount == 3);
    CHECK(sentencesOf(defects, false)[0] == "1 vertex has a coordinate that is not a finite number");
  }
}

TEST_CASE("faces with an index out of range are counted") {
  Mesh mesh = shapes::cube();
  CHECK(countFacesWithIndexOutOfRange(mesh) == 0);
  mesh.faces.push_back({0, 8, 1});
  mesh.faces.push_back({std::numeric_limits<uint32_t>::max(), 0, 1});
  CHECK(countFacesWithIndexOutOfRange(mesh) == 2);
}

TEST_CASE("input faces with fewer than three corners are counted") {
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  mesh.polygons = {{0, 2, 6, 6}, {0, 1, 0, 1, 2, 3}, {1, 1}};  // A line, a quad, nothing.
  CHECK(mesh.inputFaceCount() == 3);
  CHECK(defectsOf(mesh).shortPolygonCount == 2);
}

TEST_CASE("a second layer with vertices of its own is a layer of duplicates") {
  const Mesh twice = shapes::joined(shapes::cube(), shapes::cube());
  const MeshDefects defects = defectsOf(twice);
  CHECK(defects.duplicateFaceCount == 12);
  CHECK(defects.boundaryEdgeCount == 0);
  CHECK(defects.nonManifoldEdgeCount == 0);  // Edges go by index.
  CHECK(sentencesOf(twice) ==
        std::vector<std::string>{"12 faces duplicate earlier ones: the rays of a face ignore its copies"});
}

TEST_CASE("on a mesh of polygons the sentences count triangles and name them") {
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 3}, {2, 3, 0}}, {}};
  mesh.polygons = {{0, 4, 8}, {0, 1, 2, 3, 0, 2, 3, 0}, {0, 0, 1, 1}};
  const std::vector<std::string> sentences = sentencesOf(mesh);
  REQUIRE(sentences.size() >= 2);
  CHECK(sentences[0] == "1 triangle has zero area: it casts no rays");
  CHECK(sentences[1] == "2 triangles duplicate earlier ones: the rays of a face ignore its copies");
}
