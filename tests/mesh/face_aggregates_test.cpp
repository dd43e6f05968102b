#include "mesh/face_aggregates.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/random.h"
#include "support/shapes.h"

namespace {
using namespace asdfvk;

constexpr double kUnlimited = 1e9;

struct AggregatedShape {
  Mesh mesh;
  FaceGeometry geometry = computeFaceGeometry(mesh);
  DualGraph graph = buildDualGraph(mesh);
  std::vector<uint32_t> componentOf = std::vector<uint32_t>(mesh.faces.size(), 0);

  explicit AggregatedShape(Mesh shape) : mesh(std::move(shape)) {}
  [[nodiscard]] FaceAggregates aggregates(uint32_t arcCount, double length = kUnlimited) const {
    const std::vector<double> lengths{length, 0};
    return buildFaceAggregates(graph, geometry, {arcCount, lengths, componentOf});
  }
};

/// Arcs of a shortest path inside of the aggregate; -1 if there is no path.
int arcsFromCentre(const AggregatedShape& shape, const FaceAggregates& aggregates, uint32_t face) {
  std::vector<uint32_t> front{aggregates.centreOf(face)}, seen = front;
  for (int arcs = 0; !front.empty(); ++arcs) {
    if (std::count(front.begin(), front.end(), face) > 0) return arcs;
    std::vector<uint32_t> next;
    for (const uint32_t f : front)
      for (const uint32_t g : shape.graph.neighboursOf(f))
        if (aggregates.centreOf(g) == aggregates.centreOf(face) && std::count(seen.begin(), seen.end(), g) == 0) {
          seen.push_back(g);
          next.push_back(g);
        }
    front = next;
  }
  return -1;
}

void checkPartition(const AggregatedShape& shape, const FaceAggregates& aggregates, uint32_t arcCount,
                    double maxLength) {
  CHECK(std::is_sorted(aggregates.centres.begin(), aggregates.centres.end()));
  std::vector<uint32_t> sizes(aggregates.centres.size(), 0);
  for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face) {
    const uint32_t centre = aggregates.centreOf(face);
    REQUIRE(aggregates.isCentre(centre));
    CHECK(std::binary_search(aggregates.centres.begin(), aggregates.centres.end(), centre));
    ++sizes[aggregates.aggregateOf[face]];
    const int arcs = arcsFromCentre(shape, aggregates, face);
    CHECK(arcs >= 0);
    CHECK(arcs <= static_cast<int>(arcCount));
    if (face == centre) continue;
    CHECK(dot(shape.geometry.normals[face], shape.geometry.normals[centre]) >= std::cos(10.001 * 3.14159265 / 180));
    CHECK(length(shape.geometry.barycentres[face] - shape.geometry.barycentres[centre]) <= maxLength);
  }
  CHECK(sizes == aggregates.sizes);
}

void checkArcs(const AggregatedShape& shape, const FaceAggregates& aggregates) {
  std::set<std::pair<uint32_t, uint32_t>> expected, found;
  for (uint32_t f = 0; f < shape.mesh.faces.size(); ++f)
    for (const uint32_t g : shape.graph.neighboursOf(f))
      if (aggregates.aggregateOf[f] != aggregates.aggregateOf[g])
        expected.emplace(aggregates.aggregateOf[f], aggregates.aggregateOf[g]);
  for (uint32_t p = 0; p < aggregates.graph.faceCount(); ++p) {
    const std::span<const uint32_t> row = aggregates.graph.neighboursOf(p);
    CHECK(std::adjacent_find(row.begin(), row.end(), std::greater_equal<>()) == row.end());
    for (const uint32_t q : row) found.emplace(p, q);
  }
  CHECK(found == expected);
}

TEST_CASE("aggregates are a partition within their limits, and their arcs are their shared edges") {
  for (const uint32_t arcCount : {0u, 1u, 2u, 3u})
    for (const double maxLength : {0.05, kUnlimited}) {
      CAPTURE(arcCount);
      const AggregatedShape shape(shapes::icosphere(4));
      const FaceAggregates aggregates = shape.aggregates(arcCount, maxLength);
      checkPartition(shape, aggregates, arcCount, maxLength);
      checkArcs(shape, aggregates);
      if (arcCount == 0) CHECK(aggregates.centres.size() == shape.mesh.faces.size());
      if (arcCount == 2 && maxLength == kUnlimited) CHECK(3 * aggregates.centres.size() < shape.mesh.faces.size());
    }
}

TEST_CASE(
    "aggregates do not cross sharp edges, and faces of a component without a length are aggregates of their own") {
  AggregatedShape shape(shapes::box({1, 1, 1}, 6));
  for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face)
    shape.componentOf[face] = shape.geometry.barycentres[face].z > 0 ? 0 : 1;
  const FaceAggregates aggregates = shape.aggregates(3);
  for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face) {
    CHECK(dot(shape.geometry.normals[face], shape.geometry.normals[aggregates.centreOf(face)]) > 0.99);
    if (aggregates.isCentre(face) && shape.componentOf[face] == 1)
      CHECK(aggregates.sizes[aggregates.aggregateOf[face]] == 1);
  }
}

TEST_CASE("aggregates of a fine mesh are within blocks of faces, unless neighbours are far apart in memory") {
  Mesh fine = shapes::icosphere(6);  // 81,920 faces: two blocks.
  const AggregatedShape inOrder(fine);
  Random random(1);
  random.shuffle(std::span<Face>(fine.faces));
  const AggregatedShape shuffled(fine);
  const auto meanSizeOf = [](const AggregatedShape& shape) {
    const FaceAggregates aggregates = shape.aggregates(2);
    std::vector<uint32_t> sizes(aggregates.centres.size(), 0);
    for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face) {
      REQUIRE(aggregates.isCentre(aggregates.centreOf(face)));
      ++sizes[aggregates.aggregateOf[face]];
    }
    CHECK(sizes == aggregates.sizes);
    CHECK(std::is_sorted(aggregates.centres.begin(), aggregates.centres.end()));
    CHECK(aggregates.graph.faceCount() == sizes.size());
    return static_cast<double>(shape.mesh.faces.size()) / static_cast<double>(sizes.size());
  };
  CHECK(meanSizeOf(inOrder) > 3.5);
  CHECK(meanSizeOf(shuffled) > 3.5);
  const auto crossesBlocks = [](const AggregatedShape& shape) {
    const FaceAggregates aggregates = shape.aggregates(2);
    for (uint32_t face = 0; face < shape.mesh.faces.size(); ++face)
      if (face >> 16 != aggregates.centreOf(face) >> 16) return true;
    return false;
  };
  CHECK_FALSE(crossesBlocks(inOrder));
  CHECK(crossesBlocks(shuffled));
  checkArcs(inOrder, inOrder.aggregates(2));
}

TEST_CASE("values are spread smoothly, not across sharp edges, and not over faces without a value") {
  const AggregatedShape cube(shapes::box({1, 1, 1}, 12));
  const FaceAggregates aggregates = cube.aggregates(2);
  const auto linear = [&](uint32_t face) {
    const Vec3d &p = cube.geometry.barycentres[face], &n = cube.geometry.normals[face];
    return 10 * n.x + 20 * n.y + 40 * n.z + 3 * (p.x + p.y + p.z);
  };
  std::vector<double> values(cube.mesh.faces.size(), -1);
  for (const uint32_t centre : aggregates.centres) values[centre] = linear(centre);
  spreadFromCentres(cube.graph, cube.geometry, aggregates, values);
  double ofAggregate = 0, spread = 0;
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (aggregates.isCentre(face)) CHECK(values[face] == linear(face));
    CHECK(std::abs(values[face] - linear(face)) < 1);  // The sides differ by at least 10.
    ofAggregate += std::abs(linear(aggregates.centreOf(face)) - linear(face));
    spread += std::abs(values[face] - linear(face));
  }
  CHECK(spread < 0.6 * ofAggregate);

  values.assign(values.size(), kNoValue);
  values[aggregates.centres.front()] = 3;
  spreadFromCentres(cube.graph, cube.geometry, aggregates, values);
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (aggregates.centreOf(face) == aggregates.centres.front()) CHECK(values[face] == doctest::Approx(3));
    if (std::isfinite(values[face])) CHECK(values[face] == doctest::Approx(3));
  }
}

}  // namespace
