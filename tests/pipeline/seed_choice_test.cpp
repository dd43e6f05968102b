#include "pipeline/seed_choice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "asdf_vk/choices.h"
#include "asdf_vk/error.h"
#include "generate/shapes.h"
#include "pipeline/region.h"

using namespace asdfvk;

namespace {

/// A mesh with its PreparedMesh, which refers to the arrays of the mesh.
struct Sample {
  explicit Sample(Mesh theMesh) : mesh(std::move(theMesh)) {}

  Mesh mesh;
  PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
};

std::vector<uint32_t> joined(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  std::vector<uint32_t> all;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

bool isAscendingWithoutRepeats(const std::vector<uint32_t>& faces) {
  return std::adjacent_find(faces.begin(), faces.end(), std::greater_equal<>()) == faces.end();
}

SeedChoice joined(const SeedChoice& a, const SeedChoice& b) {
  return {joined(a.sampled, b.sampled), joined(a.heldOut, b.heldOut)};
}

SeedShares shares(uint64_t count, uint64_t heldOutCount) {
  return {.sampled = count - heldOutCount, .heldOut = heldOutCount};
}

SeedChoice choose(const PreparedMesh& mesh, const Options& options, const SeedShares& shares, const SeedChoice& earlier,
                  std::span<const double> density) {
  ArcAngles arcAngles(mesh.graph, mesh.geometry);
  Seeds seeds;
  for (const auto& [nodes, kind] :
       {std::pair(earlier.heldOut, SeedKind::HeldOut), std::pair(earlier.sampled, SeedKind::Sampled)})
    for (const uint32_t node : nodes) {
      seeds.nodes.push_back(node);
      seeds.kinds.push_back(kind);
    }
  return chooseSeeds(wholeMesh(mesh), arcAngles, options, shares, seeds, density);
}

uint64_t seedCountOf(const SeedCount& request, uint64_t faceCount, Recipe recipe = Recipe::Balanced) {
  Options options;
  applyRecipe(recipe, options);
  options.seeds = request;
  return resolveSeedCount(options, faceCount);
}

std::vector<uint32_t> allOf(const SeedChoice& choice) { return joined(choice.sampled, choice.heldOut); }

}  // namespace

TEST_CASE("a share is of the faces that can cast rays, one at least; a count is no more than there are") {
  const auto share = [](double of, uint64_t faceCount) { return seedCountOf(SeedCount::ofShare(of), faceCount); };
  CHECK(share(0.1, 1000) == 100);
  CHECK(share(0.1, 1004) == 100);
  CHECK(share(0.1, 1006) == 101);
  CHECK(share(1e-9, 1000) == 1);
  CHECK(share(1, 1000) == 1000);
  CHECK(share(0.1, 0) == 0);
  for (const double bad : {0.0, -0.1, 1.01}) CHECK_THROWS_AS((void)share(bad, 10), Error);
  CHECK(seedCountOf(SeedCount::ofCount(7), 1000) == 7);
  CHECK(seedCountOf(SeedCount::ofCount(7000), 1000) == 1000);
  CHECK_THROWS_AS((void)seedCountOf(SeedCount::ofCount(0), 10), Error);
  CHECK(seedCountOf(SeedCount::all(), 1000) == 1000);
}

TEST_CASE("an automatic number of seeds is a tenth of the faces, but no less than a fixed number or all faces") {
  const auto automatic = [](uint64_t faceCount) { return seedCountOf(SeedCount::automatic(), faceCount); };
  const uint64_t least = kMinAutomaticSeedCount;
  CHECK(automatic(0) == 0);
  CHECK(automatic(12) == 12);
  CHECK(automatic(least) == least);
  CHECK(automatic(least + 1) == least);
  CHECK(automatic(10 * least) == least);
  CHECK(automatic(10 * least + 20) == least + 2);
  CHECK(automatic(1'000'000) == 100'000);
  CHECK(seedCountOf(SeedCount::automatic(), 2000, Recipe::Quality) == 2000);
  CHECK(seedCountOf(SeedCount::automatic(), 2000, Recipe::Paper) == 200);
}

TEST_CASE("seeds are divided without a rest: at most a quarter is held out, a tenth are extreme seeds") {
  for (const uint64_t count : {0u, 1u, 3u, 9u, 10u, 100u, 1000u, 30'000u, 1'000'000u})
    for (const uint64_t earlier : {0u, 50u, 100'000u})
      for (const bool predicts : {false, true}) {
        const SeedShares shares = shareSeeds(count, earlier, predicts);
        CHECK(shares.sampled + shares.heldOut + shares.extreme == count);
        CHECK(shares.heldOut <= count / 4);
        CHECK(shares.extreme <= count / 10);
        if (!predicts) CHECK(shares.extreme == 0);
        if (earlier == 100'000u) CHECK(shares.heldOut == 0);
      }
  CHECK(shareSeeds(100, 0, true).heldOut == 25);
  CHECK(shareSeeds(100, 0, true).extreme == 10);
  CHECK(shareSeeds(200, 0, true).extreme == 16);
  CHECK(shareSeeds(1000, 0, true).extreme == 40);
  CHECK(shareSeeds(1'000'000, 0, true).heldOut <= 2000);
  CHECK(shareSeeds(1'000'000, 0, true).extreme <= 400);
  CHECK(shareSeeds(2000, 150, true).heldOut + 150 == shareSeeds(2000, 0, true).heldOut);
}

TEST_CASE("extreme seeds are the faces with the greatest predictions that are not seeds yet") {
  const Sample sample(makeSphere(80).mesh);
  const PreparedMesh& mesh = sample.prepared;
  std::vector<double> prediction(80);
  for (size_t face = 0; face < 80; ++face) prediction[face] = static_cast<double>(face % 40);
  std::vector<uint8_t> isSeed(80, 0);
  isSeed[39] = isSeed[78] = 1;
  prediction[77] = kNoValue;
  CHECK(extremeSeeds(mesh.traceableFaces, prediction, isSeed, 5) == std::vector<uint32_t>{36, 37, 38, 76, 79});
  CHECK(extremeSeeds(mesh.traceableFaces, prediction, isSeed, 1) == std::vector<uint32_t>{79});
  CHECK(extremeSeeds(mesh.traceableFaces, prediction, isSeed, 0).empty());
  CHECK(extremeSeeds(mesh.traceableFaces, prediction, isSeed, 1000).size() == 77);
}

TEST_CASE("each sampler gives the requested numbers of seeds and held-out faces, all different, in every round") {
  const Sample sample(makeAnimal(2500).mesh);
  const PreparedMesh& mesh = sample.prepared;
  for (const auto& sampler : kSamplerNames) {
    CAPTURE(sampler.first);
    Options options;
    options.sampler = sampler.second;
    SeedChoice chosen;
    for (const uint64_t count : {100u, 40u, 300u}) {
      const SeedChoice choice = choose(mesh, options, shares(count, count / 4), chosen, {});
      CHECK(choice.heldOut.size() == count / 4);
      CHECK(choice.sampled.size() == count - count / 4);
      CHECK(isAscendingWithoutRepeats(choice.sampled));
      CHECK(isAscendingWithoutRepeats(choice.heldOut));
      chosen = joined(chosen, choice);
      CHECK(isAscendingWithoutRepeats(allOf(chosen)));
    }
    CHECK(allOf(chosen).size() == 440);
  }
}

TEST_CASE("all remaining faces can be chosen") {
  const Sample sample(makeTorus(400).mesh);
  const PreparedMesh& mesh = sample.prepared;
  for (const auto& sampler : kSamplerNames) {
    CAPTURE(sampler.first);
    Options options;
    options.sampler = sampler.second;
    const SeedChoice first = choose(mesh, options, shares(100, 25), {}, {});
    const uint64_t left = mesh.traceableFaces.size() - 100;
    const SeedChoice rest = choose(mesh, options, shares(left, 0), first, {});
    CHECK(allOf(joined(first, rest)) == mesh.traceableFaces);
  }
}

TEST_CASE("random seeds do not depend on how many of them are held out") {
  const Sample sample(makeTorus(1000).mesh);
  const PreparedMesh& mesh = sample.prepared;
  Options options;
  options.sampler = SamplerChoice::Random;
  const SeedChoice without = choose(mesh, options, shares(120, 0), {}, {});
  const SeedChoice with = choose(mesh, options, shares(120, 30), {}, {});
  CHECK(without.heldOut.empty());
  CHECK(with.heldOut.size() == 30);
  CHECK(allOf(with) == without.sampled);
  CHECK(allOf(choose(mesh, options, shares(80, 20), with, {})) ==
        choose(mesh, options, shares(80, 0), without, {}).sampled);
}

TEST_CASE("held-out faces are anywhere, also next to sampled seeds") {
  // Blue noise has a minimum distance. Held-out faces with the same minimum distance would be where errors are
  // greatest.
  const Sample sample(makeSphere(2000).mesh);
  const PreparedMesh& mesh = sample.prepared;
  size_t touchingCount = 0;
  const SeedChoice choice = choose(mesh, {}, shares(400, 100), {}, {});
  std::vector<uint8_t> isSampled(2000, 0);
  for (const uint32_t face : choice.sampled) isSampled[face] = 1;
  const auto touches = [&](uint32_t face) {
    const auto neighbours = mesh.graph.neighboursOf(face);
    return std::any_of(neighbours.begin(), neighbours.end(), [&](uint32_t other) { return isSampled[other] == 1; });
  };
  size_t touchingOfAll = 0, others = 0;
  for (const uint32_t face : choice.heldOut) touchingCount += touches(face);
  for (uint32_t face = 0; face < 2000; ++face)
    if (!isSampled[face]) {
      ++others;
      touchingOfAll += touches(face);
    }
  const double share = static_cast<double>(touchingOfAll) / static_cast<double>(others);
  CHECK(static_cast<double>(touchingCount) / 100 == doctest::Approx(share).epsilon(0.3));
}

TEST_CASE("an adaptive choice is denser where the density is great") {
  const Sample sample(makeSphere(2000).mesh);
  const PreparedMesh& mesh = sample.prepared;
  std::vector<double> density(2000, 0.01);
  const auto isUp = [&](uint32_t face) { return mesh.geometry.barycentres[face].z > 0; };
  for (uint32_t face = 0; face < 2000; ++face)
    if (isUp(face)) density[face] = 1;
  Options options;
  options.sampler = SamplerChoice::Adaptive;
  const SeedChoice first = choose(mesh, options, shares(50, 12), {}, {});
  const SeedChoice second = choose(mesh, options, shares(100, 0), first, density);
  CHECK(isAscendingWithoutRepeats(allOf(joined(first, second))));
  CHECK(std::count_if(second.sampled.begin(), second.sampled.end(), isUp) > 70);
}
