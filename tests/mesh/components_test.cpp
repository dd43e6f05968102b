#include "mesh/components.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/random.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

// Whether components are closed and consistently wound, from a map of all edges.
struct Closedness {
  std::vector<bool> isClosed, isConsistentlyWound;
};

Closedness closednessByMap(const Mesh& mesh, const Components& components) {
  struct Uses {
    std::vector<uint32_t> faces;
    size_t upCount = 0;
  };
  const TriangleMesh view = mesh;
  std::map<std::pair<uint32_t, uint32_t>, Uses> edges;
  const size_t count = components.components.size();
  Closedness result{std::vector<bool>(count, false), std::vector<bool>(count, true)};
  for (uint32_t f = 0; f < view.faceCount(); ++f) {
    const Face& face = mesh.faces[f];
    if (!hasDistinctVertices(face) || !view.hasFiniteCorners(f)) continue;
    result.isClosed[components.componentOf[f]] = true;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = face[i], to = face[(i + 1) % 3];
      Uses& uses = edges[std::minmax(from, to)];
      uses.faces.push_back(f);
      uses.upCount += from < to ? 1 : 0;
    }
  }
  for (const auto& [edge, uses] : edges)
    for (const uint32_t f : uses.faces) {
      if (2 * uses.upCount == uses.faces.size()) continue;
      (uses.faces.size() % 2 == 0 ? result.isConsistentlyWound : result.isClosed)[components.componentOf[f]] = false;
    }
  return result;
}

Components componentsOf(const Mesh& mesh) {
  Components components = findComponents(mesh, surveyEdges(mesh));
  const Closedness expected = closednessByMap(mesh, components);
  for (size_t i = 0; i < components.components.size(); ++i) {
    CHECK(components.components[i].isClosed == expected.isClosed[i]);
    CHECK(components.components[i].isConsistentlyWound == expected.isConsistentlyWound[i]);
  }
  return components;
}

// By walking from face to face.
std::vector<uint32_t> componentsByWalking(const DualGraph& graph) {
  std::vector<uint32_t> componentOf(graph.faceCount(), UINT32_MAX);
  uint32_t count = 0;
  for (uint32_t first = 0; first < graph.faceCount(); ++first) {
    if (componentOf[first] != UINT32_MAX) continue;
    std::vector<uint32_t> open{first};
    componentOf[first] = count;
    while (!open.empty()) {
      const uint32_t face = open.back();
      open.pop_back();
      for (const uint32_t neighbour : graph.neighboursOf(face))
        if (componentOf[neighbour] == UINT32_MAX) {
          componentOf[neighbour] = count;
          open.push_back(neighbour);
        }
    }
    ++count;
  }
  return componentOf;
}

}  // namespace

TEST_CASE("an empty mesh has no component") { CHECK(componentsOf({}).components.empty()); }

TEST_CASE("components are numbered by their lowest face") {
  Mesh mesh = shapes::joined(shapes::cube(), shapes::scaledAndShifted(shapes::tetrahedron(), 1, {5, 0, 0}));
  std::swap(mesh.faces[1], mesh.faces[13]);
  const Components result = componentsOf(mesh);
  REQUIRE(result.components.size() == 2);
  CHECK(result.componentOf[0] == 0);
  CHECK(result.componentOf[1] == 1);
  CHECK(result.componentOf[13] == 0);
  CHECK(result.components[1].firstFace == 1);
  CHECK(result.components[0].faceCount == 12);
  CHECK(result.components[1].faceCount == 4);
}

TEST_CASE("faces that share only a vertex are not connected") {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}, {}};
  CHECK(componentsOf(mesh).components.size() == 2);
}

TEST_CASE("closed shapes have their volume, negative when inverted, at any scale and shift") {
  for (const double scale : {1e-90, 1e-30, 1.0, 1e3, 1e30, 1e90}) {
    CAPTURE(scale);
    const double volume = 8 * scale * scale * scale;
    const Mesh cube = shapes::scaledAndShifted(shapes::cube(), scale, Vec3d{1e6, -3e6, 2e6} * scale);
    const Component outward = componentsOf(cube).components[0];
    const Component inward = componentsOf(shapes::inverted(cube)).components[0];
    CHECK(outward.isClosed);
    CHECK(outward.isConsistentlyWound);
    CHECK(inward.isClosed);
    CHECK(outward.signedVolume / volume == doctest::Approx(1).epsilon(1e-9));
    CHECK(inward.signedVolume / volume == doctest::Approx(-1).epsilon(1e-9));
  }
  const double torusVolume = componentsOf(shapes::torus(3, 1, 400, 200)).components[0].signedVolume;
  CHECK(torusVolume == doctest::Approx(2 * std::numbers::pi * std::numbers::pi * 3).epsilon(1e-3));
}

TEST_CASE("a volume below the range of a double keeps its sign") {
  CHECK(componentsOf(shapes::scaledAndShifted(shapes::cube(), 1e-150)).components[0].signedVolume > 0);
  CHECK(componentsOf(shapes::inverted(shapes::scaledAndShifted(shapes::cube(), 1e-150))).components[0].signedVolume <
        0);
}

TEST_CASE("a flat pillow is closed and has no volume, in any plane") {
  for (const double slope : {0.0, 0.3, 1.7}) {
    Mesh pillow;  // Two fans over one rim, each around an apex of its own.
    const uint32_t rimCount = 11;
    for (uint32_t i = 0; i < rimCount; ++i) {
      const double angle = 2 * std::numbers::pi * i / rimCount;
      pillow.vertices.push_back({0.3 + std::cos(angle), 0.7 + std::sin(angle), 0});
      pillow.faces.push_back({i, (i + 1) % rimCount, rimCount});
      pillow.faces.push_back({(i + 1) % rimCount, i, rimCount + 1});
    }
    pillow.vertices.push_back({0.2, 0.7, 0});
    pillow.vertices.push_back({0.5, 0.6, 0});
    for (Vec3d& vertex : pillow.vertices) vertex.z = slope * vertex.x + 0.7 * vertex.y;
    const Components result = componentsOf(pillow);
    REQUIRE(result.components.size() == 1);
    CHECK(result.components[0].isClosed);
    CHECK(result.components[0].isConsistentlyWound);
    CHECK(result.components[0].signedVolume == 0);
    pillow.vertices.back().z += 1e-9;
    CHECK(componentsOf(pillow).components[0].signedVolume < 0);
  }
}

TEST_CASE("a missing face, a third face and a non-finite corner make a component open") {
  Mesh missing = shapes::cube();
  missing.faces.pop_back();
  CHECK_FALSE(componentsOf(missing).components[0].isClosed);

  Mesh third = shapes::cube();
  third.vertices.push_back({0, 0, 0});
  third.faces.push_back({0, 1, 8});
  CHECK_FALSE(componentsOf(third).components[0].isClosed);

  Mesh hole = shapes::cube();
  hole.vertices[7].x = std::numeric_limits<double>::quiet_NaN();
  const Components result = componentsOf(hole);
  for (const Component& component : result.components) CHECK_FALSE(component.isClosed);
  CHECK(result.components.size() == 1 + 6);  // Six faces at vertex 7.
}

TEST_CASE("a face with a repeated vertex neither opens a component nor is closed by itself") {
  Mesh mesh = shapes::cube();
  mesh.faces.push_back({0, 0, 1});
  mesh.faces.push_back({5, 5, 5});
  const Components result = componentsOf(mesh);
  REQUIRE(result.components.size() == 2);
  CHECK(result.components[0].isClosed);
  CHECK(result.components[0].faceCount == 13);
  CHECK_FALSE(result.components[1].isClosed);
}

TEST_CASE("books of any thickness are not closed") {
  for (uint32_t pageCount : {3u, 33u, 100u}) CHECK_FALSE(componentsOf(shapes::book(pageCount)).components[0].isClosed);
}

TEST_CASE("the copies of a shell are closed components of their own") {
  Mesh doubled = shapes::cube();
  const std::vector<Face> once = doubled.faces;
  for (const bool isInverted : {false, true}) {
    doubled.faces = once;
    for (const Face& face : once) doubled.faces.push_back(isInverted ? Face{face[0], face[2], face[1]} : face);
    const Components result = componentsOf(doubled);
    REQUIRE(result.components.size() == 2);
    for (size_t i = 0; i < 2; ++i) {
      CHECK(result.components[i].isClosed);
      CHECK(result.components[i].isConsistentlyWound);
      CHECK(result.components[i].signedVolume == doctest::Approx(i == 1 && isInverted ? -8 : 8));
    }
  }
}

TEST_CASE("solids that touch at an edge or a side of common vertices are components of their own") {
  const Mesh edge = shapes::boxesWithSharedEdge();
  REQUIRE(componentsOf(edge).components.size() == 2);
  Mesh side = shapes::joined(shapes::cube(), shapes::cube(), {2, 0, 0});
  for (Face& face : side.faces)
    for (uint32_t& vertex : face)
      for (uint32_t other = 0; other < 8; ++other)
        if (side.vertices[other] == side.vertices[vertex]) vertex = other;
  const Components touching = componentsOf(side);
  REQUIRE(touching.components.size() == 2);
  for (const Component& component : touching.components) {
    CHECK(component.isClosed);
    CHECK(component.faceCount == 12);
    CHECK(component.signedVolume == doctest::Approx(8));
  }
}

TEST_CASE("one face wound against the others makes a component inconsistent") {
  Mesh mesh = shapes::cube();
  std::swap(mesh.faces[4][1], mesh.faces[4][2]);
  const Components result = componentsOf(mesh);
  CHECK(result.components[0].isClosed);
  CHECK_FALSE(result.components[0].isConsistentlyWound);
}

TEST_CASE("closedness of random soups, with non-finite corners or not, equals that by a map of all edges") {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Mesh mesh = shapes::joined(shapes::cube(), shapes::inverted(shapes::sphere(1)));
    const auto vertexCount = static_cast<uint32_t>(mesh.vertices.size());
    // A third face at an edge, faces with a repeated vertex, and copies.
    Random random(seed);
    for (uint32_t i = 0; i < seed % 7; ++i)
      mesh.faces.push_back({random.index(8), random.index(8), random.index(vertexCount)});
    for (uint32_t i = 0; i < seed % 3; ++i) std::swap(mesh.faces[20 + i][0], mesh.faces[20 + i][1]);
    mesh = shapes::joined(std::move(mesh), shapes::randomFaces(5, 12, seed));
    if (seed % 4 == 3) mesh.vertices[random.index(vertexCount)].y = std::numeric_limits<double>::infinity();
    (void)componentsOf(mesh);
  }
}

TEST_CASE("the components of a shuffled mesh of many are all found") {
  Mesh mesh;
  for (int i = 0; i < 200; ++i)
    mesh = shapes::joined(mesh, shapes::scaledAndShifted(shapes::sphere(1), 1, {3.0 * i, 0, 0}));
  Random random(3);
  random.shuffle(std::span<Face>(mesh.faces));
  const Components result = componentsOf(mesh);
  REQUIRE(result.components.size() == 200);
  for (size_t i = 0; i < 200; ++i) {
    CHECK(result.components[i].faceCount == 32);
    CHECK(result.components[i].isClosed);
    CHECK(result.components[i].signedVolume > 0);
    if (i > 0) CHECK(result.components[i - 1].firstFace < result.components[i].firstFace);
  }
}

TEST_CASE("components of many faces in any order equal those of a breadth-first search, on any number of threads") {
  // A sheet with holes: many components, with long paths between their faces.
  Mesh mesh = shapes::grid(200);
  Random random(3);
  std::erase_if(mesh.faces, [&](const Face&) { return random.index(100) < 45; });
  const auto check = [&] {
    const std::vector<uint32_t> expected = componentsByWalking(buildDualGraph(mesh));
    for (const size_t threadCount : {1, 4}) {
      const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, threadCount);
      CHECK(std::ranges::equal(componentsOf(mesh).componentOf, expected));
    }
  };
  check();
  std::reverse(mesh.faces.begin(), mesh.faces.end());
  check();
  random.shuffle(std::span<Face>(mesh.faces));
  check();
}
