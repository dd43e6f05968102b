// Evenness of blue noise and farthest-point sampling.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "seeds/random_permutation.h"
#include "seeds/samplers.h"
#include "seeds/surface.h"
#include "seeds/surface_distances.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

constexpr std::array<SampleSeeds*, 2> kSpacingSamplers{blueNoiseSeeds, farthestPointSeeds};

struct Spacing {
  float min = 0;       ///< Smallest distance from a seed to the nearest other seed.
  float covering = 0;  ///< Largest distance from a face to the nearest seed.
};

Spacing spacingOf(const Surface& surface, std::span<const float> lengths, std::span<const uint32_t> seeds) {
  const std::vector<float> nearest = distancesToNearestOther(surface.graph, lengths, seeds);
  const std::vector<float> distances = distancesToNearest(surface.graph, lengths, seeds);
  float covering = 0;
  for (uint32_t face : surface.candidates) covering = std::max(covering, distances[face]);
  return {*std::min_element(nearest.begin(), nearest.end()), covering};
}

// The step of the radius, and the rounding of float over the arcs of a path.
constexpr float kStepAndRounding = (1 + 1.0f / 64) * 1.0001f;

std::vector<uint32_t> facesWith(const Surface& surface, auto&& predicate) {
  std::vector<uint32_t> faces;
  for (uint32_t face : surface.candidates)
    if (predicate(surface.geometry.barycentres[face])) faces.push_back(face);
  return faces;
}

}  // namespace

TEST_CASE("the covering radius is at most the smallest distance between seeds") {
  for (const char* shape : {"torus", "sphere", "cube", "hand"}) {
    CAPTURE(shape);
    const Surface& surface = generatedSurface(shape, 4000);
    const UnsetVector<float> lengths = arcLengths(arcAngles(surface.graph, surface.geometry));
    for (double share : {0.002, 0.02, 0.1, 0.3}) {
      CAPTURE(share);
      const auto count = static_cast<uint64_t>(share * static_cast<double>(surface.candidates.size()));
      for (SampleSeeds* sampler : kSpacingSamplers) {
        const Spacing spacing = spacingOf(surface, lengths, sampler(surface.domain(), count, {}, 3));
        CHECK(spacing.covering <= spacing.min * kStepAndRounding);
      }
    }
  }
}

TEST_CASE("at 10 % of the faces blue-noise seeds are at least 3 hops apart, and some random seeds are neighbours") {
  for (const char* shape : {"torus", "sphere"}) {
    CAPTURE(shape);
    const Surface& surface = generatedSurface(shape, 4000);
    const auto lengths = hops(surface.graph);
    const uint64_t count = surface.candidates.size() / 10;
    const auto blue = blueNoiseSeeds(surface.domain(), count, {}, 1);
    const auto random = randomPermutationSeeds(surface.candidates, count, 1);
    const auto blueNearest = distancesToNearestOther(surface.graph, lengths, blue);
    const auto randomNearest = distancesToNearestOther(surface.graph, lengths, random);
    CHECK(*std::min_element(blueNearest.begin(), blueNearest.end()) >= 3);
    CHECK(*std::min_element(randomNearest.begin(), randomNearest.end()) == 1);
    CHECK(meanOf(blueNearest) > 1.5 * meanOf(randomNearest));
    CHECK(meanOf(distancesToNearest(surface.graph, lengths, blue)) <
          0.85 * meanOf(distancesToNearest(surface.graph, lengths, random)));
  }
}

TEST_CASE("seeds fill the gaps between existing ones") {
  const Surface& sphere = generatedSurface("sphere", 4000);
  const UnsetVector<float> lengths = arcLengths(arcAngles(sphere.graph, sphere.geometry));
  // All faces of the northern half are seeds, so that the new seeds are in the southern half, away from the equator.
  const auto north = facesWith(sphere, [](const Vec3d& at) { return at.z > 0; });
  for (SampleSeeds* sampler : kSpacingSamplers) {
    const auto seeds = sampler(sphere.domain(), 60, north, 1);
    REQUIRE(seeds.size() == 60);
    std::vector<uint32_t> all = north;
    all.insert(all.end(), seeds.begin(), seeds.end());
    const std::vector<float> fromNorth = distancesToNearest(sphere.graph, lengths, north);
    float minDistance = std::numeric_limits<float>::infinity();
    for (uint32_t seed : seeds) minDistance = std::min(minDistance, fromNorth[seed]);
    const auto nearest = distancesToNearestOther(sphere.graph, lengths, seeds);
    minDistance = std::min(minDistance, *std::min_element(nearest.begin(), nearest.end()));
    const std::vector<float> toNearest = distancesToNearest(sphere.graph, lengths, all);
    CHECK(minDistance >= 5);
    CHECK(*std::max_element(toNearest.begin(), toNearest.end()) <= minDistance * kStepAndRounding);
  }
}

TEST_CASE("seeds added in rounds keep the spacing of seeds selected at once") {
  const Surface& torus = generatedSurface("torus", 4000);
  const UnsetVector<float> lengths = arcLengths(arcAngles(torus.graph, torus.geometry));
  for (SampleSeeds* sampler : kSpacingSamplers) {
    std::vector<uint32_t> all;
    for (uint64_t round = 0; round < 4; ++round) {
      const auto seeds = sampler(torus.domain(), 100, all, round);
      all.insert(all.end(), seeds.begin(), seeds.end());
      const Spacing spacing = spacingOf(torus, lengths, all);
      CHECK(spacing.covering <= spacing.min * kStepAndRounding);
    }
    CHECK(all.size() == 400);
  }
}

TEST_CASE("components get a first seed before any of them gets a second one") {
  Mesh mesh;
  for (uint32_t i = 0; i < 50; ++i) mesh = shapes::joined(std::move(mesh), strip(3 + i));
  const Surface surface(mesh);
  const auto componentsAmong = [&](const std::vector<uint32_t>& seeds) {
    size_t count = 0, end = 0;
    for (uint32_t i = 0, begin = 0; i < 50; ++i, begin = static_cast<uint32_t>(end)) {
      end = begin + 3 + i;
      count += std::any_of(seeds.begin(), seeds.end(), [&](uint32_t face) { return face >= begin && face < end; });
    }
    return count;
  };
  CHECK(componentsAmong(farthestPointSeeds(surface.domain(), 20, {}, 1)) == 20);
  CHECK(componentsAmong(farthestPointSeeds(surface.domain(), 50, {}, 1)) == 50);
  CHECK(componentsAmong(blueNoiseSeeds(surface.domain(), 20, {}, 1)) == 20);
  CHECK(componentsAmong(blueNoiseSeeds(surface.domain(), 50, {}, 1)) == 50);
}

TEST_CASE("farthest points of a strip are the ends and the middle for any random seed") {
  const Surface surface(strip(129));
  for (uint64_t randomSeed = 1; randomSeed < 6; ++randomSeed) {
    const std::vector<uint32_t> middle{64};
    CHECK(farthestPointSeeds(surface.domain(), 2, middle, randomSeed) == std::vector<uint32_t>{0, 128});
    const std::vector<uint32_t> ends{128, 0};
    CHECK(farthestPointSeeds(surface.domain(), 1, ends, randomSeed) == middle);
  }
}

TEST_CASE("there are more seeds where the surface bends") {
  const Surface& cube = generatedSurface("cube", 4000);
  const UnsetVector<float> lengths = arcLengths(arcAngles(cube.graph, cube.geometry));
  std::vector<uint8_t> isAtEdge(cube.graph.faceCount(), 0);
  for (uint32_t face = 0; face < cube.graph.faceCount(); ++face)
    for (uint32_t arc = cube.graph.offsets[face]; arc < cube.graph.offsets[face + 1]; ++arc)
      if (lengths[arc] > 2) isAtEdge[face] = 1;
  const auto shareAtEdge = [&](const std::vector<uint32_t>& faces) {
    const auto count = std::count_if(faces.begin(), faces.end(), [&](uint32_t face) { return isAtEdge[face] != 0; });
    return static_cast<double>(count) / static_cast<double>(faces.size());
  };
  for (SampleSeeds* sampler : kSpacingSamplers)
    CHECK(shareAtEdge(sampler(cube.domain(), 200, {}, 2)) > 1.2 * shareAtEdge(cube.candidates));
}

TEST_CASE("the number of seeds per face is proportional to the density") {
  const Surface& torus = generatedSurface("torus", 40'000);
  const auto dense = facesWith(torus, [](const Vec3d& at) { return at.x > 0; });
  const double facesInDense = static_cast<double>(dense.size());
  const double facesElsewhere = static_cast<double>(torus.graph.faceCount()) - facesInDense;
  for (double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 9.0}) {
    CAPTURE(factor);
    std::vector<double> density(torus.graph.faceCount(), 1e-3);
    for (uint32_t face : dense) density[face] *= factor;
    for (uint64_t count : {800u, 2000u, 4000u}) {
      CAPTURE(count);
      const auto seeds = weightedBlueNoiseSeeds(torus.domain(), density, count, {}, 1);
      double inDense = 0;
      for (uint32_t face : seeds) inDense += torus.geometry.barycentres[face].x > 0;
      const double elsewhere = static_cast<double>(seeds.size()) - inDense;
      const double ratio = (inDense / facesInDense) / (elsewhere / facesElsewhere);
      CHECK(ratio > 0.85 * factor);
      CHECK(ratio < 1.15 * factor);
    }
  }
}

TEST_CASE("the result is independent of the unit of the density, and a constant density gives blue noise") {
  const Surface& torus = generatedSurface("torus", 4000);
  const auto weighted = [&](double even) {
    return weightedBlueNoiseSeeds(torus.domain(), std::vector<double>(torus.graph.faceCount(), even), 300, {}, 8);
  };
  const auto seeds = weighted(1);
  CHECK(weighted(0x1p-100) == seeds);
  CHECK(weighted(0x1p+1000) == seeds);
  const auto nearest = distancesToNearestOther(torus.graph, hops(torus.graph), seeds);
  CHECK(*std::min_element(nearest.begin(), nearest.end()) >= 3);
}

TEST_CASE("a density that is not positive and finite fails a check") {
  const Surface surface(strip(3));
  for (double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    CAPTURE(wrong);
    const std::vector<double> density{1, wrong, 1};
    CHECK_THROWS_AS(static_cast<void>(weightedBlueNoiseSeeds(surface.domain(), density, 1, {}, 1)), CheckFailure);
  }
  CHECK_THROWS_AS(static_cast<void>(weightedBlueNoiseSeeds(surface.domain(), std::vector<double>{1, 1}, 1, {}, 1)),
                  CheckFailure);
}
