// Properties of every sampler.
#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <string>

#include "asdf_vk/choices.h"
#include "asdf_vk/run_control.h"
#include "core/check.h"
#include "seeds/samplers.h"
#include "seeds/surface.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/stopped_control.h"

using namespace asdfvk;

namespace {

using Seeds = std::vector<uint32_t>;
using Existing = std::span<const uint32_t>;

std::vector<uint32_t> sampleByDensity(const SeedDomain& domain, uint64_t count, Existing existing,
                                      uint64_t randomSeed) {
  std::vector<double> density(domain.graph.faceCount());
  for (size_t face = 0; face < density.size(); ++face) density[face] = 1 + static_cast<double>(face % 1000);
  return weightedBlueNoiseSeeds(domain, density, count, existing, randomSeed);
}

template <typename Body>
void forEachSampler(const Body& body) {
  for (const Sampler& sampler : kSamplers) {
    CAPTURE(nameOf(kSamplerNames, sampler.choice));
    body(sampler.sample);
  }
  body(sampleByDensity);
}

bool ascendWithoutRepeats(const Seeds& seeds) {
  return std::adjacent_find(seeds.begin(), seeds.end(), std::greater_equal<>()) == seeds.end();
}

bool areAllIn(const Seeds& seeds, std::span<const uint32_t> allowed) {
  return std::includes(allowed.begin(), allowed.end(), seeds.begin(), seeds.end());
}

/// Flat islands of 1 to 7 faces.
Mesh islands(uint32_t count) {
  Mesh mesh;
  for (uint32_t i = 0; i < count; ++i) mesh = shapes::joined(std::move(mesh), strip(1 + i % 7));
  return mesh;
}

/// Every seventh face with two equal corners, and one face with a corner at infinity.
Mesh withDegenerateFaces(Mesh mesh) {
  for (size_t face = 0; face < mesh.faces.size(); face += 7)
    mesh.vertices[mesh.faces[face][0]] = mesh.vertices[mesh.faces[face][1]];
  mesh.vertices[mesh.faces[3][0]].x = std::numeric_limits<double>::infinity();
  return mesh;
}

}  // namespace

TEST_CASE("any count of seeds is exact; they are distinct candidates, ascending") {
  const Surface& torus = generatedSurface("torus", 2000);
  const auto size = static_cast<uint64_t>(torus.candidates.size());
  forEachSampler([&](auto sample) {
    for (uint64_t count : {uint64_t{1}, uint64_t{2}, uint64_t{3}, size / 100, size / 10, size / 2, size - 1, size}) {
      CAPTURE(count);
      const Seeds seeds = sample(torus.domain(), count, {}, 5);
      CHECK(seeds.size() == count);
      CHECK(ascendWithoutRepeats(seeds));
      CHECK(areAllIn(seeds, torus.candidates));
    }
    CHECK(sample(torus.domain(), 0, {}, 5).empty());
    CHECK(sample(torus.domain(), size + 1, {}, 5) == torus.candidates);
    CHECK(sample(torus.domain(), uint64_t{1} << 60, {}, 5) == torus.candidates);
  });
}

TEST_CASE("an empty mesh, one face, and no candidate") {
  const Surface none{Mesh{}}, one(strip(1));
  const SeedDomain noCandidate{one.graph, one.geometry, one.arcAngles, {}};
  forEachSampler([&](auto sample) {
    CHECK(sample(none.domain(), 3, {}, 1).empty());
    CHECK(sample(one.domain(), 1, {}, 1) == Seeds{0});
    CHECK(sample(one.domain(), 1, Seeds{0}, 1).empty());
    CHECK(sample(noCandidate, 1, {}, 1).empty());
  });
}

TEST_CASE("a stop request ends the samplers that measure distances") {
  SeedDomain domain = generatedSurface("sphere", 1000).domain();
  domain.stopOnly = test::stoppedControl();
  for (SampleSeeds* const sample : {&blueNoiseSeeds, &farthestPointSeeds})
    test::requireFailure([&] { (void)sample(domain, 100, {}, 5); }, ErrorCode::Cancelled);
}

TEST_CASE("existing seeds are not selected again, and all remaining faces can be selected") {
  const Surface& sphere = generatedSurface("sphere", 1000);
  const auto size = static_cast<uint64_t>(sphere.candidates.size());
  forEachSampler([&](auto sample) {
    Seeds chosen = sample(sphere.domain(), 100, {}, 1);
    for (uint64_t count : {uint64_t{1}, uint64_t{57}, uint64_t{500}, size}) {
      CAPTURE(count);
      Seeds existing = chosen;
      std::reverse(existing.begin(), existing.end());
      const Seeds seeds = sample(sphere.domain(), count, existing, 2);
      CHECK(seeds.size() == std::min(count, size - chosen.size()));
      CHECK(ascendWithoutRepeats(seeds));
      Seeds both;
      std::set_union(chosen.begin(), chosen.end(), seeds.begin(), seeds.end(), std::back_inserter(both));
      CHECK(both.size() == chosen.size() + seeds.size());
      chosen = both;
    }
    CHECK(chosen == sphere.candidates);
  });
}

TEST_CASE("only candidates are seeds, on a mesh with degenerate faces") {
  const Surface dented(withDegenerateFaces(generatedSurface("torus", 2000).mesh));
  REQUIRE(dented.candidates.size() < dented.graph.faceCount());
  REQUIRE(dented.candidates.size() > 300);
  forEachSampler([&](auto sample) {
    for (uint64_t count : {uint64_t{1}, uint64_t{200}, static_cast<uint64_t>(dented.candidates.size()) - 1}) {
      CAPTURE(count);
      const Seeds seeds = sample(dented.domain(), count, Seeds{0}, 3);
      CHECK(seeds.size() == count);
      CHECK(areAllIn(seeds, dented.candidates));
    }
  });
}

TEST_CASE("components smaller than the spacing of the seeds, with fewer and with more seeds than components") {
  const Surface scattered(islands(300));
  forEachSampler([&](auto sample) {
    for (uint64_t count : {1u, 10u, 300u, 600u, 1000u}) {
      CAPTURE(count);
      const Seeds seeds = sample(scattered.domain(), count, {}, 4);
      CHECK(seeds.size() == count);
      CHECK(ascendWithoutRepeats(seeds));
      CHECK(areAllIn(seeds, scattered.candidates));
    }
  });
}

TEST_CASE("seeds are the same on every run and any number of threads, and differ with another random seed") {
  const Surface& torus = generatedSurface("torus", 20'000);
  forEachSampler([&](auto sample) {
    const Seeds seeds = sample(torus.domain(), 1500, {}, 11);
    CHECK(seeds == sample(torus.domain(), 1500, {}, 11));
    CHECK(seeds != sample(torus.domain(), 1500, {}, 12));
    const Seeds further = sample(torus.domain(), 1500, seeds, 11);
    for (uint32_t threadCount : {1u, 2u, 7u}) {
      CAPTURE(threadCount);
      const ThreadLimit limit(threadCount);
      CHECK(seeds == sample(torus.domain(), 1500, {}, 11));
      CHECK(further == sample(torus.domain(), 1500, seeds, 11));
    }
  });
}

TEST_CASE("an existing face outside of the mesh fails a check") {
  const Surface one(strip(2));
  forEachSampler(
      [&](auto sample) { CHECK_THROWS_AS(static_cast<void>(sample(one.domain(), 1, Seeds{2}, 1)), CheckFailure); });
}

TEST_CASE("each name has a sampler, and no two have the same one") {
  std::set<const Sampler*> samplers;
  for (const auto& named : kSamplerNames) {
    const Sampler& sampler = samplerOf(named.second);
    CHECK(sampler.choice == named.second);
    samplers.insert(&sampler);
  }
  CHECK(samplers.size() == kSamplers.size());
}
