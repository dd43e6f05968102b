#include "mesh/face_patches.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/random.h"
#include "support/shapes.h"

namespace {
using namespace asdfvk;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

struct PatchedShape {
  Mesh mesh;
  FaceGeometry geometry = computeFaceGeometry(mesh);
  DualGraph graph = buildDualGraph(mesh);
  std::vector<uint8_t> mayGrow = std::vector<uint8_t>(mesh.faces.size(), 1);

  explicit PatchedShape(Mesh shape) : mesh(std::move(shape)) {}
  [[nodiscard]] FacePatches patches(uint32_t arcCount, double length = kUnlimited) const {
    return buildFacePatches(graph, geometry, mayGrow, {arcCount, length});
  }
};

/// Arcs of a shortest path inside of the patch; -1 if there is no path.
int arcsFromCentre(const PatchedShape& shape, const FacePatches& patches, uint32_t face) {
  std::vector<uint32_t> front{patches.centreOf(face)}, seen = front;
  for (int arcs = 0; !front.empty(); ++arcs) {
    if (std::count(front.begin(), front.end(), face) > 0) return arcs;
    std::vector<uint32_t> next;
    for (const uint32_t f : front)
      for (const uint32_t g : shape.graph.neighboursOf(f))
        if (patches.centreOf(g) == patches.centreOf(face) && std::count(seen.begin(), seen.end(), g) == 0) {
          seen.push_back(g);
          next.push_back(g);
        }
    front = next;
  }
  return -1;
}

void checkPartition(const PatchedShape& shape, const FacePatches& patches, uint32_t arcCount, double maxLength) {
  CHECK(std::is_sorted(patches.centres.begin(), patches.centres.end()));
  std::vector<uint32_t> sizes(patches.centres.size(), 0);
  for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face) {
    const uint32_t centre = patches.centreOf(face);
    REQUIRE(patches.isCentre(centre));
    CHECK(std::binary_search(patches.centres.begin(), patches.centres.end(), centre));
    ++sizes[patches.patchOf[face]];
    const int arcs = arcsFromCentre(shape, patches, face);
    CHECK(arcs >= 0);
    CHECK(arcs <= static_cast<int>(arcCount));
    if (face == centre) continue;
    CHECK(dot(shape.geometry.normals[face], shape.geometry.normals[centre]) >= std::cos(10.001 * 3.14159265 / 180));
    CHECK(length(shape.geometry.barycentres[face] - shape.geometry.barycentres[centre]) <= maxLength);
  }
  CHECK(sizes == patches.sizes);
}

void checkArcs(const PatchedShape& shape, const FacePatches& patches) {
  std::set<std::pair<uint32_t, uint32_t>> expected, found;
  for (uint32_t f = 0; f < shape.mesh.faces.size(); ++f)
    for (const uint32_t g : shape.graph.neighboursOf(f))
      if (patches.patchOf[f] != patches.patchOf[g]) expected.emplace(patches.patchOf[f], patches.patchOf[g]);
  for (uint32_t p = 0; p < patches.graph.faceCount(); ++p) {
    const std::span<const uint32_t> row = patches.graph.neighboursOf(p);
    CHECK(std::adjacent_find(row.begin(), row.end(), std::greater_equal<>()) == row.end());
    for (const uint32_t q : row) found.emplace(p, q);
  }
  CHECK(found == expected);
}

TEST_CASE("patches are a partition within their limits, and their arcs are their shared edges") {
  for (const uint32_t arcCount : {0u, 1u, 2u, 3u})
    for (const double maxLength : {0.05, kUnlimited}) {
      CAPTURE(arcCount);
      const PatchedShape shape(shapes::icosphere(4));
      const FacePatches patches = shape.patches(arcCount, maxLength);
      checkPartition(shape, patches, arcCount, maxLength);
      checkArcs(shape, patches);
      if (arcCount == 0) CHECK(patches.centres.size() == shape.mesh.faces.size());
      if (arcCount == 2 && maxLength == kUnlimited) CHECK(3 * patches.centres.size() < shape.mesh.faces.size());
    }
}

TEST_CASE("patches do not cross sharp edges, and faces that may not grow are patches of their own") {
  PatchedShape shape(shapes::box({1, 1, 1}, 6));
  for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face)
    shape.mayGrow[face] = shape.geometry.barycentres[face].z > 0 ? 1 : 0;
  const FacePatches patches = shape.patches(3);
  for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face) {
    CHECK(dot(shape.geometry.normals[face], shape.geometry.normals[patches.centreOf(face)]) > 0.99);
    if (patches.isCentre(face) && shape.mayGrow[face] == 0) CHECK(patches.sizes[patches.patchOf[face]] == 1);
  }
}

TEST_CASE("values are spread smoothly, not across sharp edges, and not over faces without a value") {
  const PatchedShape cube(shapes::box({1, 1, 1}, 12));
  const FacePatches patches = cube.patches(2);
  const auto linear = [&](uint32_t face) {
    const Vec3d &p = cube.geometry.barycentres[face], &n = cube.geometry.normals[face];
    return 10 * n.x + 20 * n.y + 40 * n.z + 3 * (p.x + p.y + p.z);
  };
  std::vector<double> values(cube.mesh.faces.size(), -1);
  for (const uint32_t centre : patches.centres) values[centre] = linear(centre);
  spreadFromCentres(cube.graph, cube.geometry, patches, values);
  double ofPatch = 0, spread = 0;
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (patches.isCentre(face)) CHECK(values[face] == linear(face));
    CHECK(std::abs(values[face] - linear(face)) < 1);  // The sides differ by at least 10.
    ofPatch += std::abs(linear(patches.centreOf(face)) - linear(face));
    spread += std::abs(values[face] - linear(face));
  }
  CHECK(spread < 0.6 * ofPatch);

  values.assign(values.size(), std::numeric_limits<double>::quiet_NaN());
  values[patches.centres.front()] = 3;
  spreadFromCentres(cube.graph, cube.geometry, patches, values);
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (patches.centreOf(face) == patches.centres.front()) CHECK(values[face] == doctest::Approx(3));
    if (std::isfinite(values[face])) CHECK(values[face] == doctest::Approx(3));
  }
}

}  // namespace
