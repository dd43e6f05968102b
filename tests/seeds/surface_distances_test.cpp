#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "seeds/surface.h"
#include "seeds/surface_distances.h"
#include "support/shapes.h"

using namespace asdfvk;

TEST_CASE("distances to a growing set of seeds equal the definition up to the limit") {
  const Surface& hand = generatedSurface("hand", 3000);
  for (const UnsetVector<float>& lengths : {hops(hand.graph), arcLengths(arcAngles(hand.graph, hand.geometry))}) {
    SurfaceDistances distances(hand.graph, lengths);
    Random random(6);
    std::vector<uint32_t> seeds;
    for (float limit : {SurfaceDistances::kUnreached, 20.0f, 8.0f, 8.0f, 3.0f}) {
      CAPTURE(limit);
      std::vector<uint32_t> further;
      for (int i = 0; i < 10; ++i) further.push_back(random.index(hand.graph.faceCount()));
      seeds.insert(seeds.end(), further.begin(), further.end());
      distances.add(further, limit);
      const std::vector<float> expected = distancesToNearest(hand.graph, lengths, seeds);
      size_t belowLimitCount = 0;
      for (uint32_t face = 0; face < hand.graph.faceCount(); ++face) {
        if (expected[face] >= limit) {
          CHECK(distances.at(face) >= expected[face]);
          continue;
        }
        ++belowLimitCount;
        CHECK(distances.at(face) == doctest::Approx(expected[face]));
      }
      CHECK(belowLimitCount > seeds.size());
    }
    distances.clear();
    CHECK(distances.at(seeds[0]) == SurfaceDistances::kUnreached);
  }
}

TEST_CASE("distances over more arcs than the queue visits, with arcs of very different lengths, equal the definition") {
  const Surface surface(shapes::joined(strip(1000), generatedSurface("torus", 20'000).mesh));
  std::vector<float> lengths(surface.graph.neighbours.size());
  for (uint32_t face = 0; face < surface.graph.faceCount(); ++face) {
    for (uint32_t arc = surface.graph.offsets[face]; arc < surface.graph.offsets[face + 1]; ++arc) {
      const uint64_t sum = uint64_t{face} + surface.graph.neighbours[arc];
      lengths[arc] = static_cast<float>(std::exp2(20 * Random(sum).real() - 10));
    }
  }
  const std::vector<uint32_t> seeds{2, 5000, 900};
  SurfaceDistances distances(surface.graph, lengths);
  distances.add(seeds, SurfaceDistances::kUnreached);
  const std::vector<float> expected = distancesToNearest(surface.graph, lengths, seeds);
  size_t differentCount = 0;
  for (uint32_t face = 0; face < surface.graph.faceCount(); ++face)
    differentCount += distances.at(face) != expected[face];
  CHECK(differentCount == 0);
}

TEST_CASE("each ball lists all faces of the component once, nearest first") {
  const Surface surface(shapes::joined(generatedSurface("torus", 500).mesh, strip(5)));
  const UnsetVector<float> lengths = arcLengths(arcAngles(surface.graph, surface.geometry));
  SurfaceBall ball(surface.graph, lengths);
  const uint32_t islandBegin = surface.graph.faceCount() - 5;
  for (uint32_t centre : {0u, 77u, islandBegin + 2, 78u}) {
    CAPTURE(centre);
    const std::vector<uint32_t> seed{centre};
    const std::vector<float> expected = distancesToNearest(surface.graph, lengths, seed);
    ball.startAt(centre);
    SurfaceBall::Member member;
    std::vector<uint32_t> faces;
    float last = 0;
    while (ball.next(member)) {
      CHECK(member.distance >= last);
      CHECK(member.distance == doctest::Approx(expected[member.face]));
      last = member.distance;
      faces.push_back(member.face);
    }
    CHECK(faces.front() == centre);
    std::sort(faces.begin(), faces.end());
    CHECK(std::adjacent_find(faces.begin(), faces.end()) == faces.end());
    CHECK(faces.size() == (centre < islandBegin ? islandBegin : 5));
  }
}
