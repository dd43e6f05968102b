#include "mesh/orientation.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "support/shapes.h"

using namespace asdfvk;
using shapes::inverted;
using shapes::joined;
using shapes::scaledAndShifted;
using shapes::sphere;

namespace {

using Indices = std::vector<uint32_t>;
using Cavities = std::vector<int>;

struct Analysis {
  Components components;
  OrientationReport report;
};

Analysis analyse(const Mesh& mesh) {
  Analysis result{findComponents(mesh, surveyEdges(mesh)), {}};
  result.report = analyseOrientation(mesh, result.components);
  return result;
}

Indices invertedIn(const Mesh& mesh) { return analyse(mesh).report.invertedComponents; }
Cavities cavitiesIn(const Mesh& mesh) {
  const std::vector<uint8_t> isCavity = analyse(mesh).report.isCavity;
  return {isCavity.begin(), isCavity.end()};
}

}  // namespace

TEST_CASE("a lone closed shape is inverted when its volume is negative") {
  CHECK(invertedIn({}).empty());
  CHECK(invertedIn(sphere(2)).empty());
  CHECK(invertedIn(inverted(sphere(2))) == Indices{0});
  for (const double scale : {1e-170, 1e-150, 1e160, 1.7e308}) {
    CAPTURE(scale);
    CHECK(invertedIn(scaledAndShifted(sphere(2), scale)).empty());
    CHECK(invertedIn(inverted(scaledAndShifted(sphere(2), scale))) == Indices{0});
  }
  CHECK(invertedIn(inverted(scaledAndShifted(sphere(2), 1e-3, {1e5, 1e5, 1e5}))) == Indices{0});
}

TEST_CASE("a cavity is oriented inwards") {
  const Mesh outer = sphere(3), inner = scaledAndShifted(sphere(2), 0.5, {0.1, 0.2, 0});
  CHECK(cavitiesIn(joined(outer, inner)) == Cavities{0, 1});
  CHECK(invertedIn(joined(outer, inverted(inner))).empty());
  CHECK(invertedIn(joined(outer, inner)) == Indices{1});
  CHECK(invertedIn(joined(inverted(inner), outer)).empty());
  CHECK(invertedIn(joined(inverted(outer), inner)) == Indices{0, 1});
}

TEST_CASE("spheres in each other alternate") {
  const Mesh nested =
      joined(joined(sphere(2), scaledAndShifted(sphere(3), 0.7)), scaledAndShifted(sphere(2), 0.3, {0.1, 0, 0}));
  CHECK(cavitiesIn(nested) == Cavities{0, 1, 0});
  CHECK(invertedIn(nested) == Indices{1});
  CHECK(invertedIn(inverted(nested)) == Indices{0, 2});
}

TEST_CASE("a sphere in a torus's hole is in its box but not inside it") {
  const Mesh torus = shapes::torus(3, 1, 40, 20);
  CHECK(cavitiesIn(joined(torus, scaledAndShifted(sphere(3), 0.9))) == Cavities{0, 0});
  CHECK(invertedIn(joined(torus, scaledAndShifted(inverted(sphere(3)), 0.9))) == Indices{1});
  CHECK(cavitiesIn(joined(torus, scaledAndShifted(sphere(3), 0.9, {3, 0, 0}))) == Cavities{0, 1});
}

TEST_CASE("a shape that sticks out of another one or equals it is not inside it") {
  CHECK(cavitiesIn(joined(sphere(3), scaledAndShifted(sphere(2), 0.5, {0.45, 0.45, 0.45}))) == Cavities{0, 0});
  CHECK(cavitiesIn(joined(shapes::cube(), shapes::cube())) == Cavities{0, 0});
  // The smaller cube touches the larger one.
  CHECK(cavitiesIn(joined(shapes::cube(), scaledAndShifted(shapes::cube(), 0.5, {0.5, 0, 0}))) == Cavities{0, 0});
}

TEST_CASE("test rays through corners and edges of a container cross the right number of faces") {
  CHECK(cavitiesIn(joined(shapes::cube(), scaledAndShifted(shapes::cube(), 0.5))) == Cavities{0, 1});
  CHECK(cavitiesIn(joined(sphere(0), scaledAndShifted(sphere(0), 0.5))) == Cavities{0, 1});
  CHECK(cavitiesIn(joined(shapes::grid(4), scaledAndShifted(shapes::cube(), 0.5, {2, 2, 1}))) == Cavities{0, 0});
}

TEST_CASE("open and inconsistently wound components are never inverted") {
  Mesh open = inverted(sphere(2));
  open.faces.pop_back();
  CHECK(invertedIn(open).empty());
  CHECK(cavitiesIn(joined(open, scaledAndShifted(sphere(2), 0.5))) == Cavities{0, 0});

  Mesh mixed = inverted(sphere(2));
  std::swap(mixed.faces[5][1], mixed.faces[5][2]);
  CHECK(invertedIn(mixed).empty());
  CHECK(cavitiesIn(joined(mixed, scaledAndShifted(sphere(2), 0.5))) == Cavities{0, 1});  // It still encloses.
}

TEST_CASE("cavities are found at any scale, shift and number of threads") {
  const Mesh nested = joined(joined(sphere(4), scaledAndShifted(sphere(4), 0.7)), scaledAndShifted(sphere(4), 0.3));
  for (const double scale : {1e-150, 1e-30, 1e-3, 1e3, 1e30, 1e150})
    CHECK(cavitiesIn(scaledAndShifted(nested, scale)) == Cavities{0, 1, 0});
  CHECK(cavitiesIn(scaledAndShifted(nested, 1, {1e6, -1e6, 1e6})) == Cavities{0, 1, 0});
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(cavitiesIn(nested) == Cavities{0, 1, 0});
}

TEST_CASE("of thousands of components each cavity is found") {
  const int n = 12;  // Shells on a grid; every third one has a core, and all are inside of one large sphere.
  Mesh mesh = scaledAndShifted(sphere(5), 40);
  Cavities expected{0};
  Random random(11);
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3d centre{3.0 * (i % n) - 16.5, 3.0 * (i / n % n) - 16.5, 3.0 * (i / n / n) - 16.5};
    mesh = joined(std::move(mesh), scaledAndShifted(sphere(1), 1, centre));
    expected.push_back(1);
    if (i % 3 != 0) continue;
    mesh = joined(std::move(mesh), scaledAndShifted(shapes::cube(), 0.3 + 0.1 * random.real(), centre));
    expected.push_back(0);
  }
  CHECK(cavitiesIn(mesh) == expected);
}

TEST_CASE("orienting reverses the inverted components only, once, and their derived data") {
  Mesh mesh = joined(joined(inverted(sphere(2)), inverted(scaledAndShifted(sphere(1), 0.5))),
                     scaledAndShifted(inverted(shapes::cube()), 1, {5, 0, 0}));
  FaceGeometry geometry = computeFaceGeometry(mesh);
  Analysis analysis = analyse(mesh);
  CHECK(analysis.report.invertedComponents == Indices{0, 2});
  CHECK(
      analysis.report.sentence(mesh, analysis.components) ==
      "2 of 3 components are inverted (face 0 and the 127 connected to it, face 160 and the 11 connected to it): their "
      "rays leave the solid");
  const Mesh before = mesh;
  orientOutward(mesh, geometry, analysis.components, analysis.report);
  CHECK(analysis.report.sentence(mesh, analysis.components).empty());
  CHECK(invertedIn(mesh).empty());
  CHECK(mesh.faces[128] == before.faces[128]);
  CHECK(mesh.faces[0] == Face{before.faces[0][0], before.faces[0][2], before.faces[0][1]});
  const FaceGeometry recomputed = computeFaceGeometry(mesh);
  CHECK(geometry.normals == recomputed.normals);
  CHECK(geometry.barycentres == recomputed.barycentres);
  const Components again = analyse(mesh).components;
  for (size_t i = 0; i < 3; ++i)
    CHECK(analysis.components.components[i].signedVolume ==
          doctest::Approx(again.components[i].signedVolume).epsilon(1e-12));
}

TEST_CASE("one inverted component is named in the singular") {
  const Mesh mesh = inverted(shapes::tetrahedron());
  const Analysis analysis = analyse(mesh);
  CHECK(analysis.report.sentence(mesh, analysis.components) ==
        "1 of 1 components is inverted (face 0 and the 3 connected to it): its rays leave the solid");
}

TEST_CASE("inverted components of a mesh of polygons are named by input faces") {
  Mesh mesh = joined(shapes::cube(), scaledAndShifted(inverted(shapes::cube()), 1, {5, 0, 0}));
  mesh.polygons.firstCorner = {0, 2};  // A line comes before the twelve quads.
  mesh.polygons.corners = {0, 1};
  for (uint32_t quad = 0; quad < 12; ++quad) {
    const Face &first = mesh.faces[2 * quad], &second = mesh.faces[2 * quad + 1];
    const bool isTurned = quad >= 6;
    mesh.polygons.corners.insert(mesh.polygons.corners.end(), {first[0], first[1], first[2], second[isTurned ? 1 : 2]});
    mesh.polygons.firstCorner.push_back(mesh.polygons.corners.size());
    mesh.polygons.inputFaceOf.insert(mesh.polygons.inputFaceOf.end(), {quad + 1, quad + 1});
  }
  const Analysis analysis = analyse(mesh);
  CHECK(analysis.report.sentence(mesh, analysis.components) ==
        "1 of 2 components is inverted (face 7 and the 5 connected to it): its rays leave the solid");
}

TEST_CASE("flipping turns an input face's corners once, however many triangles it was cut into") {
  // A pentagon of three triangles, a line, a triangle and a quad.
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {-1, 1, 0}, {9, 9, 9}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {1, 2, 5}, {1, 5, 3}};
  mesh.polygons = {{0, 5, 7, 10, 14}, {0, 1, 2, 3, 4, 0, 1, 0, 4, 5, 1, 2, 5, 3}, {0, 0, 0, 2, 3, 3}};
  FaceGeometry geometry = computeFaceGeometry(mesh);
  flipFaces(mesh, geometry, std::vector<uint8_t>{1, 1, 1, 0, 1, 1});
  CHECK(mesh.polygons.corners == Indices{0, 4, 3, 2, 1, 0, 1, 0, 4, 5, 1, 3, 5, 2});
  CHECK(mesh.faces[0] == Face{0, 2, 1});
  CHECK(mesh.faces[3] == Face{0, 4, 5});
  CHECK(geometry.normals[0] == Vec3d{0, 0, -1});
  CHECK_THROWS_AS(flipFaces(mesh, geometry, std::vector<uint8_t>{1}), CheckFailure);
}

TEST_CASE("a polygon is reversed even if its first triangle repeats a corner") {
  // An inverted cube of quads. The first quad repeats its second corner, so that its first triangle is an edge, which
  // belongs to no closed component.
  Mesh mesh = inverted(shapes::cube());
  mesh.polygons.firstCorner = {0};
  for (uint32_t quad = 0; quad < 6; ++quad) {
    const Face first = mesh.faces[2 * quad], second = mesh.faces[2 * quad + 1];
    std::vector<uint32_t>& corners = mesh.polygons.corners;
    corners.insert(corners.end(), {first[0], second[1], first[1], first[2]});
    if (quad == 0) corners.insert(corners.begin() + 1, corners[1]);
    mesh.polygons.firstCorner.push_back(corners.size());
    mesh.polygons.inputFaceOf.insert(mesh.polygons.inputFaceOf.end(), {quad, quad});
  }
  const Face edge{mesh.polygons.corners[0], mesh.polygons.corners[1], mesh.polygons.corners[1]};
  mesh.faces.insert(mesh.faces.begin(), edge);
  mesh.polygons.inputFaceOf.insert(mesh.polygons.inputFaceOf.begin(), 0);
  const Mesh before = mesh;

  FaceGeometry geometry = computeFaceGeometry(mesh);
  Analysis analysis = analyse(mesh);
  REQUIRE(analysis.report.invertedComponents.size() == 1);
  orientOutward(mesh, geometry, analysis.components, analysis.report);
  Mesh asCaller = before;
  flipInputFaces(asCaller, std::vector<uint64_t>{0, 1, 2, 3, 4, 5});
  for (size_t i = 0; i < 6; ++i) {
    CAPTURE(i);
    std::vector<uint32_t> reversed(before.polygons.corners.begin() + int(before.polygons.firstCorner[i]),
                                   before.polygons.corners.begin() + int(before.polygons.firstCorner[i + 1]));
    std::reverse(reversed.begin() + 1, reversed.end());
    CHECK(std::equal(reversed.begin(), reversed.end(),
                     mesh.polygons.corners.begin() + int(before.polygons.firstCorner[i])));
  }
  CHECK(asCaller.polygons.corners == mesh.polygons.corners);
  CHECK(std::equal(asCaller.faces.begin() + 1, asCaller.faces.end(), mesh.faces.begin() + 1));
}

TEST_CASE("only the named input faces are reversed") {
  Mesh mesh = shapes::tetrahedron();
  const std::vector<Face> before = mesh.faces;
  flipInputFaces(mesh, std::vector<uint64_t>{1, 3});
  CHECK(mesh.faces == std::vector<Face>{before[0],
                                        {before[1][0], before[1][2], before[1][1]},
                                        before[2],
                                        {before[3][0], before[3][2], before[3][1]}});
}

TEST_CASE("flipping all faces inverts everything, open or not, and keeps degenerate normals at zero") {
  Mesh mesh = joined(shapes::grid(2), scaledAndShifted(sphere(1), 1, {0, 0, 5}));
  mesh.faces.push_back({0, 0, 1});
  FaceGeometry geometry = computeFaceGeometry(mesh);
  Components components = findComponents(mesh, surveyEdges(mesh));
  const double volume = components.components[1].signedVolume;
  flipAllFaces(mesh, geometry, components);
  CHECK(components.components[1].signedVolume == -volume);
  CHECK(geometry.normals[0] == Vec3d{0, 0, -1});
  CHECK(geometry.normals == computeFaceGeometry(mesh).normals);
  CHECK_FALSE(std::signbit(geometry.normals.back().x));
  CHECK(invertedIn(mesh) == Indices{1});
}
