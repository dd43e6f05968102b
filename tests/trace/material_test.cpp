#include "trace/material.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/point2.h"
#include "core/random.h"
#include "support/shapes.h"
#include "trace/winding_number.h"
#include "traced_mesh.h"

// Winding numbers, and the kinds of faces, of shapes whose material is known.

using namespace asdfvk;

namespace {

Material materialOf(const TracedMesh& traced, const Mesh& mesh, bool isFlipped = false) {
  const EdgeSurvey edges = surveyEdges(mesh);
  return {traced.scene(), edges.graph, findComponents(mesh, edges), isFlipped, {}};
}

std::vector<FaceKind> kindsOf(const Mesh& mesh, bool isFlipped = false) {
  const TracedMesh traced(mesh);
  const Material material = materialOf(traced, mesh, isFlipped);
  std::vector<FaceKind> kinds;
  for (uint32_t face = 0; face < mesh.faces.size(); ++face) kinds.push_back(material.kindOf(face));
  return kinds;
}

void checkKinds(const Mesh& mesh, const std::vector<FaceKind>& ofParts, bool isFlipped = false) {
  const std::vector<FaceKind> kinds = kindsOf(mesh, isFlipped);
  const size_t size = kinds.size() / ofParts.size();
  for (size_t face = 0; face < kinds.size(); ++face) {
    CAPTURE(face);
    CHECK(kinds[face] == ofParts[face / size]);
  }
}

using enum FaceKind;

}  // namespace

TEST_CASE("winding numbers are those of overlapping, inverted and copied balls") {
  Mesh mesh = shapes::joined(shapes::icosphere(2), shapes::icosphere(2), {1, 0.1, 0});
  mesh = shapes::joined(std::move(mesh), shapes::inverted(shapes::icosphere(2)), {6, 0, 0});
  mesh = shapes::joined(std::move(mesh), shapes::icosphere(2), {10, 0, 0});
  mesh = shapes::joined(std::move(mesh), shapes::icosphere(2), {10, 0, 0});
  const TracedMesh traced(mesh);
  const TraceScene scene = traced.scene();
  std::vector<uint32_t> weights(mesh.faces.size());
  for (uint32_t face = 0; face < weights.size(); ++face) ++weights[scene.representatives[face]];
  Random random(7);
  for (int i = 0; i < 400; ++i) {
    const Vec3d p{14 * random.real() - 2, 3 * random.real() - 1.5, 3 * random.real() - 1.5};
    int expected = 0;
    bool isClear = true;
    for (const auto& [centre, sign] : {std::pair(Vec3d{0, 0, 0}, 1), std::pair(Vec3d{1, 0.1, 0}, 1),
                                       std::pair(Vec3d{6, 0, 0}, -1), std::pair(Vec3d{10, 0, 0}, 2)}) {
      const double distance = length(p - centre);
      isClear = isClear && (distance < 0.95 || distance > 1);
      expected += distance < 0.95 ? sign : 0;
    }
    if (isClear) CHECK(windingNumberAt(scene, weights, scene.bvh.normalization.toNormalized(p)) == expected);
  }
  // Along edges and through vertices of a box.
  const Mesh box = shapes::box({2, 2, 2}, 2);
  const TracedMesh ofBox(box);
  const std::vector<uint32_t> ones(box.faces.size(), 1);
  for (const double x : {-1.5, -0.5, 0.0, 0.5, 1.5})
    for (const double y : {-1.5, 0.0, 0.5})
      CHECK(windingNumberAt(ofBox.scene(), ones, {x, y, 0}) == (std::abs(x) < 1 && std::abs(y) < 1 ? 1 : 0));
}

TEST_CASE("all faces of a component that meets no face have one kind") {
  const Mesh ball = shapes::icosphere(1), small = shapes::icosphere(1, 0.4);
  checkKinds(ball, {Boundary});
  checkKinds(shapes::inverted(ball), {Inverted});
  checkKinds(shapes::joined(ball, ball, {3, 0, 0}), {Boundary, Boundary});
  checkKinds(shapes::joined(ball, shapes::inverted(small)), {Boundary, Boundary});  // A cavity.
  checkKinds(shapes::joined(ball, small), {Boundary, Inside});                      // Both outwards.
  checkKinds(shapes::joined(ball, shapes::inverted(ball), {3, 0, 0}), {Boundary, Inverted});
  checkKinds(shapes::joined(ball, ball), {Boundary, Boundary});                          // Copies.
  checkKinds(shapes::joined(ball, shapes::inverted(ball)), {NoThickness, NoThickness});  // Double-sided.
}

TEST_CASE("a mesh that is flipped on purpose is the boundary of what is outside of it") {
  const Mesh ball = shapes::icosphere(1);
  checkKinds(shapes::inverted(ball), {Boundary}, true);
  checkKinds(ball, {Boundary}, true);
  checkKinds(shapes::inverted(shapes::joined(ball, ball, {3, 0, 0})), {Boundary, Boundary}, true);
}

TEST_CASE("sheets without a volume have no thickness, alone and as a fin of a solid") {
  const Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, {}};
  checkKinds(sheet, {NoThickness});
  const std::vector<FaceKind> kinds = kindsOf(shapes::joined(shapes::box({4, 4, 4}), sheet, {5, 0, 0}));
  CHECK(std::count(kinds.begin(), kinds.end(), Boundary) == 12);
  CHECK(std::count(kinds.begin() + 12, kinds.end(), NoThickness) == 4);
  // A plate with a fin of less than the resolution, as one surface: its two long sides have no thickness.
  Mesh rib;
  const std::vector<Point2> outline{{0, 0},          {20, 0},  {20, 5}, {10 + 1e-5, 5},
                                    {10 + 1e-5, 15}, {10, 15}, {10, 5}, {0, 5}};
  for (const double z : {0.0, 30.0})
    for (const Point2& p : outline) rib.vertices.push_back({p.x, p.y, z});
  for (uint32_t i = 0; i < 8; ++i) {
    const uint32_t j = (i + 1) % 8;
    rib.faces.insert(rib.faces.end(), {{i, j, 8 + j}, {i, 8 + j, 8 + i}});
  }
  for (const Face& face : {Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 3, 6}, Face{0, 6, 7}, Face{6, 3, 4}, Face{6, 4, 5}}) {
    rib.faces.push_back({face[0], face[2], face[1]});
    rib.faces.push_back({face[0] + 8, face[1] + 8, face[2] + 8});
  }
  const std::vector<FaceKind> ofRib = kindsOf(rib);
  for (const size_t side : {3, 5})
    for (size_t i = 0; i < 2; ++i) CHECK(ofRib[2 * side + i] == NoThickness);
  for (const size_t side : {0, 1, 2, 6, 7}) CHECK(ofRib[2 * side] == Boundary);
}

TEST_CASE("the pieces of crossed faces cover them, each with its kind") {
  const Mesh mesh = shapes::joined(shapes::box({4, 4, 1}), shapes::box({1, 1, 5}), {0.05, 0.1, 0.03});
  const TracedMesh traced(mesh);
  const Material material = materialOf(traced, mesh);
  const double scale = traced.scene().bvh.normalization.scale;
  double insideArea = 0, boundaryArea = 0;
  for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
    const double area = traced.geometry.areas[face];
    if (!material.isCut(face)) {
      CHECK(material.kindOf(face) == Boundary);
      boundaryArea += area;
      continue;
    }
    double sum = 0;
    for (const FacePiece& piece : material.piecesOf(face)) {
      double ofPiece = 0;
      for (size_t k = 1; k + 1 < piece.corners.size(); ++k)
        ofPiece += triangleArea({piece.corners[0], piece.corners[k], piece.corners[k + 1]}) / scale / scale;
      sum += ofPiece;
      (piece.kind == Inside ? insideArea : boundaryArea) += ofPiece;
      CHECK((piece.kind == Inside || piece.kind == Boundary));
    }
    CHECK(sum == doctest::Approx(area).epsilon(1e-6));
  }
  // Inside: the pin in the plate (its sides), and the plate in the pin (both sides).
  CHECK(insideArea == doctest::Approx(4 * 1 + 2 * 1).epsilon(1e-6));
  CHECK(boundaryArea == doctest::Approx(2 * 16 + 4 * 4 + 4 * 5 + 2 - 6).epsilon(1e-6));
}

TEST_CASE("where solids touch is inside of the material, and the rest of their faces is not") {
  const Mesh mesh = shapes::joined(shapes::box({4, 4, 1}), shapes::box({1, 1, 1}), {0.3, 0.2, 1});
  const TracedMesh traced(mesh);
  const Material material = materialOf(traced, mesh);
  const double scale = traced.scene().bvh.normalization.scale;
  double insideArea = 0;
  for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
    if (!material.isCut(face)) {
      insideArea += material.kindOf(face) == Inside ? traced.geometry.areas[face] : 0;
      continue;
    }
    for (const FacePiece& piece : material.piecesOf(face))
      for (size_t k = 1; piece.kind == Inside && k + 1 < piece.corners.size(); ++k)
        insideArea += triangleArea({piece.corners[0], piece.corners[k], piece.corners[k + 1]}) / scale / scale;
  }
  CHECK(insideArea == doctest::Approx(2).epsilon(1e-6));  // The bottom of the cube, and as much of the plate.
  CHECK(material.meetingComponents().size() == 1);
}
