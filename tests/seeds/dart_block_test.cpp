// Darts of parallel blocks equal those that are thrown one after another.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "asdf_vk/run_control.h"
#include "core/random.h"
#include "seeds/dart_block.h"
#include "seeds/dart_throwing.h"
#include "seeds/surface.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

std::vector<uint32_t> shuffled(std::vector<uint32_t> faces, uint64_t randomSeed) {
  Random(randomSeed).shuffle(std::span<uint32_t>(faces));
  return faces;
}

/// Many components of 1 to 60 faces beside a torus.
const Surface& scatteredSurface() {
  static const Surface surface = [] {
    Mesh mesh = generatedSurface("torus", 20'000).mesh;
    for (uint32_t i = 0; i < 120; ++i) mesh = shapes::joined(std::move(mesh), strip(1 + i / 2));
    return Surface(mesh);
  }();
  return surface;
}

}  // namespace

TEST_CASE("the darts and their order are the same for 1, 2 and 7 threads") {
  for (const Surface* surface : {&generatedSurface("hand", 20'000), &scatteredSurface()}) {
    CAPTURE(surface->candidates.size());
    const std::vector<float> lengths = arcLengths(surface->graph, surface->geometry);
    const std::vector<uint32_t> order = shuffled(surface->candidates, 5);
    const std::vector<uint32_t> existing(order.begin(), order.begin() + 300);
    const std::vector<uint32_t> waiting(order.begin() + 300, order.end());
    const auto thrown = [&](uint32_t threadCount, uint64_t count, float startRadius) {
      const ThreadLimit limit(threadCount);
      SurfaceDistances distances(surface->graph, lengths);
      distances.add(existing, startRadius);
      return throwDarts(waiting, count, startRadius, distances);
    };
    // More than 2000 darts fit at the first start radius, and fewer than 600 at the others.
    for (float startRadius : {2.0f, 9.0f, 40.0f}) {
      CAPTURE(startRadius);
      for (uint64_t count : {uint64_t{600}, uint64_t{2000}, uint64_t{9000}, uint64_t{waiting.size()}}) {
        CAPTURE(count);
        const ThrownDarts alone = thrown(1, count, startRadius);
        CHECK(alone.faces.size() == count);
        CHECK(alone.leaveGaps == (startRadius == 2 && count <= 2000));
        for (uint32_t threadCount : {2u, 7u}) {
          CAPTURE(threadCount);
          const ThrownDarts together = thrown(threadCount, count, startRadius);
          CHECK(together.faces == alone.faces);
          CHECK(together.leaveGaps == alone.leaveGaps);
        }
      }
    }
  }
}

TEST_CASE("a block accepts the darts, and leaves the distances, of a throw at one face after another") {
  const Surface& hand = generatedSurface("hand", 20'000);
  const std::vector<float> lengths = arcLengths(hand.graph, hand.geometry);
  const std::vector<uint32_t> order = shuffled(hand.candidates, 6);
  for (float radius : {1.5f, 4.0f, 30.0f}) {
    CAPTURE(radius);
    SurfaceDistances inBlocks(hand.graph, lengths), alone(hand.graph, lengths);
    DartBlock block(inBlocks);
    uint64_t rejectedCount = 0;
    for (size_t begin = 0, size = 1; begin < order.size(); begin += size, size = 4 * size) {
      const auto faces = std::span(order).subspan(begin, std::min(size, order.size() - begin));
      block.throwAt(faces, radius, faces.size());
      CHECK_FALSE(block.isOverfull());
      std::vector<uint32_t> darts;
      bool areDistancesEqual = true;
      for (size_t i = 0; i < faces.size(); ++i) {
        areDistancesEqual = areDistancesEqual && block.distanceAt(i) == alone.at(faces[i]);
        if (alone.at(faces[i]) < radius) continue;
        alone.add({&faces[i], 1}, radius);
        darts.push_back(static_cast<uint32_t>(i));
      }
      CHECK(areDistancesEqual);
      CHECK(block.darts() == darts);
      CHECK(block.openCount() >= darts.size());
      rejectedCount += block.openCount() - darts.size();
      CHECK(std::equal(inBlocks.values().begin(), inBlocks.values().end(), alone.values().begin()));
    }
    CHECK(rejectedCount > 0);
  }
}

TEST_CASE("a block is overfull if a face beyond the last dart could be accepted") {
  const Surface surface(strip(100));
  const std::vector<float> lengths = arcLengths(surface.graph, surface.geometry);
  const std::vector<uint32_t> faces{0, 10, 1, 20, 30};
  const auto thrown = [&](uint64_t maxDarts) {
    SurfaceDistances distances(surface.graph, lengths);
    DartBlock block(distances);
    block.throwAt(faces, 5, maxDarts);
    return std::pair(block.darts(), block.isOverfull());
  };
  CHECK(thrown(4) == std::pair(std::vector<uint32_t>{0, 1, 3, 4}, false));
  CHECK(thrown(3) == std::pair(std::vector<uint32_t>{0, 1, 3}, true));
  CHECK(thrown(2) == std::pair(std::vector<uint32_t>{0, 1}, true));
  CHECK(thrown(0) == std::pair(std::vector<uint32_t>{}, true));
}
