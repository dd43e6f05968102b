#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "seeds/depth_first.h"
#include "seeds/random_permutation.h"
#include "seeds/surface.h"
#include "seeds/surface_metric.h"

using namespace asdfvk;

TEST_CASE("the order of a strip is its faces in a row, components by their lowest face") {
  const Surface surface(together(strip(6), strip(3)));
  CHECK(depthFirstOrder(surface.graph) == std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("the order goes down before it goes wide") {
  // Face 0 in the middle of 1, 2 and 3; beyond 1 is 4.
  const DualGraph graph{{0, 3, 5, 6, 7, 8}, {1, 2, 3, 0, 4, 0, 0, 1}};
  CHECK(depthFirstOrder(graph) == std::vector<uint32_t>{0, 1, 4, 2, 3});
}

TEST_CASE("every face is in the order once, and mostly follows a neighbour") {
  const Surface& hand = generatedSurface("hand", 3000);
  const std::vector<uint32_t> order = depthFirstOrder(hand.graph);
  std::vector<uint32_t> sorted = order, all(hand.graph.faceCount());
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0u);
  REQUIRE(sorted == all);
  size_t neighbourCount = 0;
  for (size_t i = 1; i < order.size(); ++i) {
    const auto neighbours = hand.graph.neighboursOf(order[i - 1]);
    neighbourCount += std::count(neighbours.begin(), neighbours.end(), order[i]) > 0;
  }
  CHECK(neighbourCount > 0.7 * static_cast<double>(order.size()));
}

TEST_CASE("the gaps between seeds in depth-first order differ by one face at most") {
  const Surface& torus = generatedSurface("torus", 4000);
  const std::vector<uint32_t> order = depthFirstOrder(torus.graph);
  std::vector<uint32_t> placeOf(order.size());
  for (uint32_t i = 0; i < order.size(); ++i) placeOf[order[i]] = i;
  for (uint64_t count : {7u, 100u, 399u, 1999u}) {
    CAPTURE(count);
    std::vector<uint32_t> places;
    for (uint32_t face : depthFirstSeeds(torus.domain(), count, {}, 2)) places.push_back(placeOf[face]);
    std::sort(places.begin(), places.end());
    const auto stride = static_cast<uint32_t>(order.size() / count);
    CHECK(places.front() <= stride);
    CHECK(places.back() + stride + 1 >= order.size());
    for (size_t i = 1; i < places.size(); ++i) {
      CHECK(places[i] - places[i - 1] >= stride);
      CHECK(places[i] - places[i - 1] <= stride + 1);
    }
  }
}

TEST_CASE("with existing seeds it is every n-th of the others") {
  const Surface surface(strip(100));
  std::vector<uint32_t> existing(50);
  std::iota(existing.begin(), existing.end(), 25u);
  const auto seeds = depthFirstSeeds(surface.domain(), 10, existing, 1);
  REQUIRE(seeds.size() == 10);
  const auto placeOf = [](uint32_t face) { return face < 25 ? face : face - 50; };
  for (size_t i = 1; i < seeds.size(); ++i) CHECK(placeOf(seeds[i]) - placeOf(seeds[i - 1]) == 5);
}

TEST_CASE("seeds lie more evenly than random ones") {
  const Surface& torus = generatedSurface("torus", 4000);
  const auto hops = arcLengths(torus.graph, torus.geometry, SurfaceMetric::Hops);
  const auto ordered = depthFirstSeeds(torus.domain(), 400, {}, 1);
  const auto random = randomPermutationSeeds(torus.candidates, 400, 1);
  CHECK(meanOf(distancesToNearest(torus.graph, hops, ordered)) <
        0.97 * meanOf(distancesToNearest(torus.graph, hops, random)));
}
