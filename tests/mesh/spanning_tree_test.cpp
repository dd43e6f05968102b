#include "mesh/spanning_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>
#include <vector>

#include "asdf_vk/error.h"
#include "core/random.h"

using namespace asdfvk;

namespace {

/// The length of a minimum spanning tree, by Prim's algorithm.
double leastLength(const std::vector<Vec3d>& points) {
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  std::vector<uint8_t> isIn(points.size());
  double sum = 0;
  distance[0] = 0;
  for (size_t step = 0; step < points.size(); ++step) {
    size_t next = points.size();
    for (size_t i = 0; i < points.size(); ++i)
      if (isIn[i] == 0 && (next == points.size() || distance[i] < distance[next])) next = i;
    isIn[next] = 1;
    sum += distance[next];
    for (size_t i = 0; i < points.size(); ++i) distance[i] = std::min(distance[i], length(points[i] - points[next]));
  }
  return sum;
}

/// The length of the edges. Requires that they are a tree of all points.
double lengthOfTree(const std::vector<Vec3d>& points, const std::vector<std::array<uint32_t, 2>>& edges) {
  REQUIRE(edges.size() + 1 == points.size());
  std::vector<uint32_t> group(points.size());
  for (uint32_t i = 0; i < group.size(); ++i) group[i] = i;
  double sum = 0;
  for (const auto& [a, b] : edges) {
    REQUIRE(group[a] != group[b]);
    std::replace(group.begin(), group.end(), uint32_t{group[b]}, uint32_t{group[a]});
    sum += length(points[a] - points[b]);
  }
  return sum;
}

}  // namespace

TEST_CASE("the minimum spanning tree has the length of Prim's") {
  Random random(5);
  const auto anywhere = [&] { return Vec3d{random.real(), random.real(), random.real()}; };
  for (const size_t count : {2, 3, 9, 40, 500, 1500})
    for (const int kind : {0, 1, 2, 3, 4}) {
      CAPTURE(count);
      CAPTURE(kind);
      std::vector<Vec3d> points;
      for (size_t i = 0; i < count; ++i) {
        Vec3d p = anywhere();
        if (kind == 1) p = {std::floor(9 * p.x), std::floor(9 * p.y), std::floor(9 * p.z)};  // Ties and duplicates.
        if (kind == 2) p = {p.x, 0, 0};
        if (kind == 3) p = 0.01 * p + Vec3d{i % 2 == 0 ? 0.0 : 50.0, 0, 0};  // Two clusters.
        if (kind == 4) p = {0.25, 0.5, 0.75};
        points.push_back(p);
      }
      CHECK(lengthOfTree(points, minimumSpanningTree(points)) == doctest::Approx(leastLength(points)).epsilon(1e-12));
    }
}

TEST_CASE("the minimum spanning tree has checkpoints at all stages, and ends at each of them on request") {
  constexpr uint32_t kPointCount = 20'000;
  Random random(7);
  std::vector<Vec3d> points;
  for (uint32_t i = 0; i < kPointCount; ++i) points.push_back({random.real(), random.real(), random.real()});
  const auto run = [&](int stopAt) {
    std::stop_source stop;
    int callCount = 0;
    double last = 0;
    const RunControl control{stop.get_token(),
                             [&](double fraction) {
                               CHECK(fraction >= last);
                               last = fraction;
                               if (++callCount == stopAt) stop.request_stop();
                             },
                             {}};
    try {
      (void)minimumSpanningTree(points, control);
      CHECK(stopAt == 0);
      CHECK(last > 0.9);
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::Cancelled);
      CHECK(callCount == stopAt);
    }
    return callCount;
  };
  const int all = run(0);
  CHECK(all > 60);  // About 5 for the tree of nodes, and 20 per round.
  for (const int stopAt : {1, 6, all / 2, all - 1}) (void)run(stopAt);
}

TEST_CASE("the minimum spanning tree does not depend on the unit") {
  Random random(6);
  std::vector<Vec3d> points;
  for (size_t i = 0; i < 300; ++i) points.push_back({random.real(), random.real(), random.real()});
  const auto edges = minimumSpanningTree(points);
  for (const double scale : {0x1p-1000, 0x1p-300, 0x1p300, 0x1p1000}) {
    std::vector<Vec3d> scaled;
    for (const Vec3d& p : points) scaled.push_back(scale * p);
    CHECK(minimumSpanningTree(scaled) == edges);
  }
  CHECK(minimumSpanningTree({}).empty());
  CHECK(minimumSpanningTree(std::span(points).first(1)).empty());
}
