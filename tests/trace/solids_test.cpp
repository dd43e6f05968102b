#include "trace/solids.h"

#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "support/shapes.h"

using namespace asdfvk;

namespace {

Solids solidsOf(const Mesh& mesh) { return findSolids(mesh, findComponents(mesh, surveyEdges(mesh))); }

/// The solid of each component; all faces of a component have the same one.
std::vector<uint32_t> solidOfComponents(const Mesh& mesh) {
  const Components components = findComponents(mesh, surveyEdges(mesh));
  const Solids solids = solidsOf(mesh);
  std::vector<uint32_t> result;
  for (const Component& component : components.components) result.push_back(solids.solidOf[component.firstFace]);
  for (size_t face = 0; face < mesh.faces.size(); ++face)
    CHECK(solids.solidOf[face] == result[components.componentOf[face]]);
  return result;
}

Mesh ball(double radius) { return shapes::icosphere(1, radius); }
Mesh cavity(double radius) { return shapes::inverted(ball(radius)); }

using Flags = std::vector<uint8_t>;
using Indices = std::vector<uint32_t>;

}  // namespace

TEST_CASE("a cavity belongs to its outer component, in any order") {
  for (const bool cavityFirst : {false, true}) {
    const Mesh mesh = cavityFirst ? shapes::joined(cavity(1), ball(2)) : shapes::joined(ball(2), cavity(1));
    const uint32_t outer = cavityFirst ? 1 : 0;
    const Solids solids = solidsOf(mesh);
    CHECK(solidOfComponents(mesh) == Indices{outer, outer});
    CHECK(solids.isClosed[outer] == 1);
    CHECK(solids.isClosed[1 - outer] == 0);
  }
}

TEST_CASE("a cavity of nested solids belongs to the smallest one around it") {
  Mesh mesh = shapes::joined(ball(10), cavity(8));
  mesh = shapes::joined(std::move(mesh), ball(6));
  mesh = shapes::joined(std::move(mesh), cavity(4));
  mesh = shapes::joined(std::move(mesh), ball(3), {30, 0, 0});
  mesh = shapes::joined(std::move(mesh), cavity(1), {30.5, 0, 0});
  CHECK(solidOfComponents(mesh) == Indices{0, 0, 2, 2, 4, 4});
  CHECK(solidsOf(mesh).isClosed == Flags{1, 0, 1, 0, 1, 0});
}

TEST_CASE("one body, bodies beside each other and bodies through each other are solids of their own") {
  CHECK(solidOfComponents(ball(1)) == Indices{0});
  CHECK(solidsOf(ball(1)).isClosed == Flags{1});
  for (const double distance : {3.0, 1.0}) {
    const Mesh two = shapes::joined(ball(1), ball(1), {distance, 0.1, 0});
    CHECK(solidOfComponents(two) == Indices{0, 1});
    CHECK(solidsOf(two).isClosed == Flags{1, 1});
  }
}

TEST_CASE("components wound inwards, inconsistently, or outwards in a cavity are not closed solids") {
  CHECK(solidsOf(cavity(1)).isClosed == Flags{0});
  Mesh mixed = ball(1);
  std::swap(mixed.faces[7][0], mixed.faces[7][1]);
  CHECK(solidsOf(mixed).isClosed == Flags{0});
  // The inner ball is a cavity that faces the wrong way.
  const Mesh nested = shapes::joined(ball(2), ball(1));
  CHECK(solidsOf(nested).isClosed == Flags{1, 0});
  CHECK(solidOfComponents(nested) == Indices{0, 0});
  // The outer one does: the cavity has no closed solid.
  const Mesh wrong = shapes::joined(cavity(2), cavity(1));
  CHECK(solidsOf(wrong).isClosed == Flags{0, 0});
  CHECK(solidOfComponents(wrong) == Indices{0, 1});
}

TEST_CASE("open components are not closed solids, and have no cavities") {
  for (const Mesh& open : {shapes::grid(3), shapes::openBox({4, 4, 4}, 2), shapes::inverted(shapes::grid(2))}) {
    const Mesh mesh = shapes::joined(open, ball(1));
    const Solids solids = solidsOf(mesh);
    CHECK(solids.isClosed == Flags{0, 1});
    CHECK(solidOfComponents(mesh) == Indices{0, 1});
  }
}

TEST_CASE("a cavity belongs to the body around it, not to a smaller one whose box is around it") {
  const Mesh bar = shapes::box({1, 1, 20}), ring = shapes::torus(2, 0.5, 24, 12);
  const Mesh mesh = shapes::joined(shapes::joined(ring, shapes::inverted(shapes::box({0.2, 0.3, 0.4}))), bar);
  CHECK(solidOfComponents(mesh) == Indices{0, 2, 2});
  CHECK(solidsOf(mesh).isClosed == Flags{1, 0, 1});
}

TEST_CASE("a cavity belongs to its body beside other cavities, and where it is filled") {
  Mesh mesh = shapes::box({10, 10, 10});
  for (const double x : {-3.0, -1.0, 1.0, 3.0})
    for (const double y : {-3.0, -1.0, 1.0, 3.0})
      for (const double z : {-3.0, -1.0, 1.0, 3.0})
        mesh = shapes::joined(std::move(mesh), shapes::inverted(shapes::box({1.9, 1.9, 1.9})), {x, y, z});
  CHECK(solidOfComponents(mesh) == Indices(65, 0));
  mesh = shapes::joined(std::move(mesh), shapes::box({1.9, 1.9, 1.9}, 2), {1, -1, 1});
  Indices expected(66, 0);
  expected.back() = 65;
  CHECK(solidOfComponents(mesh) == expected);
}

TEST_CASE("only faces of closed solids are of a body") {
  const Solids solids = solidsOf(shapes::joined(shapes::joined(ball(2), cavity(1)), shapes::grid(3), {5, 0, 0}));
  const uint32_t outer = 0, inner = 80, sheet = 160;
  CHECK(solids.bodyOf(outer) == 0);
  CHECK(solids.bodyOf(inner) == 0);
  CHECK(solids.bodyOf(sheet) == kNoBody);
  CHECK(solids.mayBoundOneBody(inner, outer));
  CHECK(solids.mayBoundOneBody(inner, sheet));
  const Solids apart = solidsOf(shapes::joined(ball(1), ball(1), {3, 0, 0}));
  CHECK_FALSE(apart.mayBoundOneBody(0, 80));
}
