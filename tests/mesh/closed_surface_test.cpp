#include "mesh/closed_surface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/random.h"
#include "generate/solids.h"
#include "mesh/components.h"
#include "mesh/winding.h"
#include "support/shapes.h"

// The edges of surfaces with split vertices, nearly equal vertices and T-junctions.

using namespace asdfvk;

namespace {

Normalization unitOf(const Mesh& mesh) { return normalizationOf(computeFaceGeometry(mesh).bounds); }
SurfaceEdges surfaceOf(const Mesh& mesh) { return surveySurface(mesh, unitOf(mesh)); }

Components componentsOf(const Mesh& mesh, const SurfaceEdges& edges) {
  TriangleMesh welded = mesh;
  if (!edges.faces.empty()) welded.faces = edges.faces;
  return findComponents(welded, edges.survey);
}

/// Every face with vertices of its own, which are moved by up to `amount`.
Mesh split(const Mesh& mesh, double amount = 0, uint64_t seed = 1) {
  Mesh result = solids::separated(mesh);
  Random random(seed);
  for (Vec3d& p : result.vertices)
    for (size_t axis = 0; axis < 3; ++axis) p[axis] += amount * (2 * random.real() - 1);
  return result;
}

/// A box whose top is cut at half of its length, but not its sides.
Mesh withTJunctions() {
  Mesh mesh = shapes::cube();
  std::erase_if(mesh.faces, [&](const Face& face) {
    return std::all_of(face.begin(), face.end(), [&](uint32_t vertex) { return mesh.vertices[vertex].z == 1; });
  });
  const auto at = [&](double x, double y) {
    const Vec3d p{x, y, 1};
    const auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
    if (found == mesh.vertices.end()) mesh.vertices.push_back(p);
    return static_cast<uint32_t>(std::find(mesh.vertices.begin(), mesh.vertices.end(), p) - mesh.vertices.begin());
  };
  for (const double x : {-1.0, 0.0}) {
    const uint32_t a = at(x, -1), b = at(x + 1, -1), c = at(x + 1, 1), d = at(x, 1);
    mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
  }
  return mesh;
}

Mesh turned(Mesh mesh) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Vec3d& v : mesh.vertices) v = {c * v.x - s * v.y + 0.13, s * v.x + c * v.y - 0.2, 0.9 * v.z + 0.1 * v.x};
  return mesh;
}

void checkIsClosed(const Mesh& mesh, size_t componentCount = 1) {
  const SurfaceEdges edges = surfaceOf(mesh);
  CHECK(edges.survey.isChainClosed());
  const Components components = componentsOf(mesh, edges);
  REQUIRE(components.components.size() == componentCount);
  for (const Component& component : components.components) {
    CHECK(component.isClosed);
    CHECK(component.isConsistentlyWound);
    CHECK(component.signedVolume > 0);
  }
}

}  // namespace

TEST_CASE("a closed mesh is not welded, even if vertices of two bodies are at one point") {
  const SurfaceEdges edges = surfaceOf(shapes::joined(shapes::cube(), shapes::cube(), {2, 0, 0}));
  CHECK(edges.faces.empty());
  CHECK(edges.weldedVertexCount == 0);
  checkIsClosed(shapes::joined(shapes::cube(), shapes::cube(), {2, 0, 0}), 2);
}

TEST_CASE("split vertices are welded, at any rotation, in any unit") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Mesh mesh = shapes::scaledAndShifted(split(turned(shapes::sphere(2))), scale);
    const SurfaceEdges edges = surfaceOf(mesh);
    CHECK(edges.weldedVertexCount == mesh.vertices.size() - 66);
    CHECK(edges.weldDistance == 0);
    checkIsClosed(mesh);
  }
}

TEST_CASE("nearly equal vertices are one point below the distance of float32, or where that closes a component") {
  const double half = 1;
  CHECK(surfaceOf(split(shapes::cube(), 1e-16)).weldDistance < 1e-15);
  checkIsClosed(split(shapes::cube(), 1e-16));
  checkIsClosed(split(shapes::cube(), 0.25 * kWeldDistance * half));
  // CAD programs: 1e-5 of the longest side.
  checkIsClosed(split(shapes::cube(), 0.25 * kCadWeldDistance * half));
  CHECK(surfaceOf(split(shapes::cube(), 0.25 * kCadWeldDistance * half)).weldDistance > kWeldDistance);
  const SurfaceEdges apart = surfaceOf(split(shapes::cube(), 10 * kCadWeldDistance * half));
  CHECK(apart.survey.countOf(EdgeKind::Boundary) == 36);
  CHECK(apart.weldedVertexCount == 0);
}

TEST_CASE("the distance of CAD programs welds only components that it closes") {
  const double amount = 0.25 * kCadWeldDistance * 3.5;
  Mesh open = split(shapes::openBox({2, 2, 2}, 1), amount);
  const size_t openCount = open.faces.size();
  const Mesh mesh = shapes::joined(std::move(open), split(shapes::cube(), amount), {5, 0, 0});
  const SurfaceEdges edges = surfaceOf(mesh);
  const Components components = componentsOf(mesh, edges);
  CHECK(components.components.back().isClosed);
  CHECK(components.components.back().faceCount == 12);
  for (size_t i = 0; i + 1 < components.components.size(); ++i) CHECK_FALSE(components.components[i].isClosed);
  for (size_t f = 0; f < openCount; ++f)
    for (size_t i = 0; i < 3; ++i) {
      const Vec3d moved = mesh.vertices[edges.faces[f][i]] - mesh.vertices[mesh.faces[f][i]];
      CHECK(length(moved) <= kWeldDistance * 3.5 * 1.001);
    }
}

TEST_CASE("split vertices of touching bodies give the bodies back") {
  checkIsClosed(split(shapes::joined(shapes::cube(), shapes::cube(), {2, 0, 0})), 2);
  checkIsClosed(split(shapes::joined(shapes::cube(), shapes::cube(), {2, 2, 0})), 2);
  checkIsClosed(split(shapes::joined(shapes::cube(), shapes::cube())), 2);
}

TEST_CASE("T-junctions do not open a surface, and join the faces") {
  for (const Mesh& mesh : {withTJunctions(), turned(withTJunctions()), split(withTJunctions()),
                           split(turned(withTJunctions()), 0.2 * kWeldDistance)}) {
    checkIsClosed(mesh);
    CHECK(surfaceOf(mesh).survey.countOf(EdgeKind::Boundary) == 0);
  }
  CHECK(surveyEdges(withTJunctions()).countOf(EdgeKind::Boundary) == 6);
}

TEST_CASE("what is left of a T-junction is open, with its place") {
  Mesh mesh = withTJunctions();
  mesh.faces.pop_back();
  mesh.faces.pop_back();
  const SurfaceEdges edges = surfaceOf(mesh);
  CHECK(edges.survey.countOf(EdgeKind::Boundary) == 4);
  const Vec3d place = edges.survey.of(EdgeKind::Boundary).place;
  CHECK(place.z == 1);
  CHECK(place.x >= 0);
  const Components components = componentsOf(mesh, edges);
  REQUIRE(components.components.size() == 1);
  CHECK_FALSE(components.components[0].isClosed);
}

TEST_CASE("three faces at an edge are a branching, two in one direction are inconsistent") {
  Mesh imprinted = shapes::joined(shapes::cube(), shapes::cube(), {2, 0, 0});
  // The common side is there once.
  std::erase_if(imprinted.faces, [&](const Face& face) {
    return std::all_of(face.begin(), face.end(), [&](uint32_t v) { return v >= 8 && imprinted.vertices[v].x == 1; });
  });
  CHECK(surfaceOf(imprinted).survey.countOf(EdgeKind::Boundary) == 4);  // The second cube alone is open.
  for (Face& face : imprinted.faces)
    for (uint32_t& vertex : face)
      for (uint32_t other = 0; other < 8; ++other)
        if (imprinted.vertices[other] == imprinted.vertices[vertex]) vertex = other;
  const SurfaceEdges edges = surfaceOf(imprinted);
  CHECK(edges.survey.countOf(EdgeKind::Branching) == 4);
  CHECK(edges.survey.countOf(EdgeKind::Boundary) == 0);
  Mesh mixed = shapes::cube();
  std::swap(mixed.faces[3][0], mixed.faces[3][1]);
  CHECK(surfaceOf(mixed).survey.countOf(EdgeKind::Inconsistent) == 3);
}

TEST_CASE("faces that are wound against their neighbours are found, also over T-junctions and split vertices") {
  for (const Mesh& closed : {shapes::sphere(2), withTJunctions(), split(withTJunctions()), split(shapes::cube())})
    for (const size_t step : {1, 3, 5}) {
      Mesh mesh = closed;
      std::vector<uint8_t> expected(mesh.faces.size(), 0);
      for (size_t f = 1; f < mesh.faces.size() && f < 4 * step; f += step) {
        if (3 * f > mesh.faces.size()) break;
        std::swap(mesh.faces[f][1], mesh.faces[f][2]);
        expected[f] = 1;
      }
      const SurfaceEdges edges = surfaceOf(mesh);
      TriangleMesh welded = mesh;
      if (!edges.faces.empty()) welded.faces = edges.faces;
      CHECK(findTurnedFaces(welded, unitOf(mesh), edges) == expected);
      CHECK(canBeTurned(mesh, unitOf(mesh)));
    }
}

TEST_CASE("a Moebius strip is not turned") {
  Mesh mesh;
  constexpr uint32_t kCount = 12;
  for (uint32_t i = 0; i < kCount; ++i) {
    const double u = 2 * 3.14159265358979 * i / kCount;
    for (const double w : {-0.3, 0.3})
      mesh.vertices.push_back(
          {(2 + w * std::cos(u / 2)) * std::cos(u), (2 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2)});
  }
  for (uint32_t i = 0; i < kCount; ++i) {
    const uint32_t a = 2 * i, b = a + 1, c = i + 1 < kCount ? a + 2 : 1, d = i + 1 < kCount ? a + 3 : 0;
    mesh.faces.insert(mesh.faces.end(), {{a, c, b}, {b, c, d}});
  }
  const SurfaceEdges edges = surfaceOf(mesh);
  CHECK(edges.survey.countOf(EdgeKind::Inconsistent) == 1);
  CHECK(findTurnedFaces(mesh, unitOf(mesh), edges) == std::vector<uint8_t>(mesh.faces.size(), 0));
  CHECK_FALSE(canBeTurned(mesh, unitOf(mesh)));
}

TEST_CASE("conforming faces have whole edges in common, and cover the faces") {
  // A triangle with two vertices of others on its first side and one on its second side.
  const Mesh shared{{{0, 0, 0}, {3, 0, 0}, {1.5, 2, 0}, {1, 0, 0}, {2, 0, 0}, {1.5, -2, 0}, {2.25, 1, 0}, {4, 2, 0}},
                    {{0, 1, 2}, {3, 0, 5}, {4, 3, 5}, {1, 4, 5}, {6, 1, 7}, {2, 6, 7}},
                    {}};
  for (const Mesh& mesh : {shared, split(shared, 1e-8)}) {
    const std::vector<FacePart> parts = conformingFaces(mesh, unitOf(mesh));
    REQUIRE(parts.size() == 9);
    CHECK(std::is_sorted(parts.begin(), parts.end(),
                         [](const FacePart& a, const FacePart& b) { return a.face < b.face; }));
    Mesh conforming{mesh.vertices, {}, {}};
    std::vector<double> areas(mesh.faces.size());
    for (const FacePart& part : parts) {
      const auto& [a, b, c] = part.vertices;
      const Vec3d normal = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
      CHECK(normal.z > 0.1);
      areas[part.face] += normal.z / 2;
      conforming.faces.push_back(part.vertices);
    }
    const FaceGeometry geometry = computeFaceGeometry(mesh);
    for (size_t f = 0; f < areas.size(); ++f) CHECK(areas[f] == doctest::Approx(geometry.areas[f]).epsilon(1e-6));
    const EdgeSurvey survey = surveyEdges(conforming);
    CHECK(survey.countOf(EdgeKind::Boundary) == 5);  // The outline.
    CHECK(survey.countOf(EdgeKind::Inconsistent) == 0);
  }
  CHECK(conformingFaces(Mesh{}, {}).empty());
  const Mesh cube = shapes::cube();
  const std::vector<FacePart> same = conformingFaces(cube, unitOf(cube));
  REQUIRE(same.size() == cube.faces.size());
  for (uint32_t f = 0; f < same.size(); ++f) CHECK((same[f].face == f && same[f].vertices == cube.faces[f]));
}
