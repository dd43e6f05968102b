#include "pipeline/seed_choice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>

#include "asdf_vk/error.h"
#include "generate/shapes.h"

using namespace asdfvk;

namespace {

PreparedMesh prepared(Mesh mesh) { return prepareMesh(mesh, Orientation::Keep); }

std::vector<uint32_t> joined(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  std::vector<uint32_t> all;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

bool isAscendingWithoutRepeats(const std::vector<uint32_t>& faces) {
  return std::adjacent_find(faces.begin(), faces.end(), std::greater_equal<>()) == faces.end();
}

SeedChoice joined(const SeedChoice& a, const SeedChoice& b) {
  return {joined(a.placed, b.placed), joined(a.probes, b.probes)};
}

SeedShares shares(uint64_t count, uint64_t probeCount) { return {.placed = count - probeCount, .probes = probeCount}; }

std::vector<uint32_t> allOf(const SeedChoice& choice) { return joined(choice.placed, choice.probes); }

}  // namespace

TEST_CASE("a share is of the faces that can cast rays, one at least; a count is no more than there are") {
  const auto share = [](double of, uint64_t faceCount) {
    return resolveSeedCount({.kind = SeedCount::Kind::Share, .share = of}, faceCount);
  };
  CHECK(share(0.1, 1000) == 100);
  CHECK(share(0.1, 1004) == 100);
  CHECK(share(0.1, 1006) == 101);
  CHECK(share(1e-9, 1000) == 1);
  CHECK(share(1, 1000) == 1000);
  CHECK(share(0.1, 0) == 0);
  for (const double bad : {0.0, -0.1, 1.01}) CHECK_THROWS_AS((void)share(bad, 10), Error);
  CHECK(resolveSeedCount({.kind = SeedCount::Kind::Count, .count = 7}, 1000) == 7);
  CHECK(resolveSeedCount({.kind = SeedCount::Kind::Count, .count = 7000}, 1000) == 1000);
  CHECK_THROWS_AS((void)resolveSeedCount({.kind = SeedCount::Kind::Count, .count = 0}, 10), Error);
  CHECK(resolveSeedCount({.kind = SeedCount::Kind::All}, 1000) == 1000);
}

TEST_CASE("seeds are shared out without a rest: at most a quarter for probes, a tenth for scouts") {
  for (const uint64_t count : {0u, 1u, 3u, 9u, 10u, 100u, 1000u, 30'000u, 1'000'000u})
    for (const uint64_t earlier : {0u, 50u, 100'000u})
      for (const bool predicts : {false, true}) {
        const SeedShares shares = shareOut(count, earlier, predicts);
        CHECK(shares.placed + shares.probes + shares.scouts == count);
        CHECK(shares.probes <= count / 4);
        CHECK(shares.scouts <= count / 10);
        if (!predicts) CHECK(shares.scouts == 0);
        if (earlier == 100'000u) CHECK(shares.probes == 0);
      }
  CHECK(shareOut(100, 0, true).probes == 25);
  CHECK(shareOut(100, 0, true).scouts == 10);
  CHECK(shareOut(200, 0, true).scouts == 16);
  CHECK(shareOut(1000, 0, true).scouts == 40);
  CHECK(shareOut(1'000'000, 0, true).probes <= 2000);
  CHECK(shareOut(1'000'000, 0, true).scouts <= 400);
  CHECK(shareOut(2000, 150, true).probes + 150 == shareOut(2000, 0, true).probes);
}

TEST_CASE("scouts are the faces with the greatest predictions that are no seeds yet") {
  const PreparedMesh mesh = prepared(makeSphere(80).mesh);
  std::vector<double> prediction(80);
  for (size_t face = 0; face < 80; ++face) prediction[face] = static_cast<double>(face % 40);
  std::vector<uint8_t> isSeed(80, 0);
  isSeed[39] = isSeed[78] = 1;
  prediction[77] = kNoValue;
  CHECK(chooseScouts(mesh, prediction, isSeed, 5) == std::vector<uint32_t>{36, 37, 38, 76, 79});
  CHECK(chooseScouts(mesh, prediction, isSeed, 1) == std::vector<uint32_t>{79});
  CHECK(chooseScouts(mesh, prediction, isSeed, 0).empty());
  CHECK(chooseScouts(mesh, prediction, isSeed, 1000).size() == 77);
}

TEST_CASE("each sampler gives as many placed seeds and probes as were asked for, all different, round by round") {
  const PreparedMesh mesh = prepared(makeAnimal(2500).mesh);
  for (const std::string& sampler : samplerNames()) {
    CAPTURE(sampler);
    Options options;
    options.sampler = sampler;
    SeedChoice chosen;
    for (const uint64_t count : {100u, 40u, 300u}) {
      const SeedChoice choice = chooseSeeds(mesh, options, shares(count, count / 4), chosen, {});
      CHECK(choice.probes.size() == count / 4);
      CHECK(choice.placed.size() == count - count / 4);
      CHECK(isAscendingWithoutRepeats(choice.placed));
      CHECK(isAscendingWithoutRepeats(choice.probes));
      chosen = joined(chosen, choice);
      CHECK(isAscendingWithoutRepeats(allOf(chosen)));
    }
    CHECK(allOf(chosen).size() == 440);
  }
}

TEST_CASE("the faces that are left are all chosen in the end") {
  const PreparedMesh mesh = prepared(makeTorus(400).mesh);
  for (const std::string& sampler : samplerNames()) {
    CAPTURE(sampler);
    Options options;
    options.sampler = sampler;
    const SeedChoice first = chooseSeeds(mesh, options, shares(100, 25), {}, {});
    const uint64_t left = mesh.castableFaces.size() - 100;
    const SeedChoice rest = chooseSeeds(mesh, options, shares(left, 0), first, {});
    CHECK(allOf(joined(first, rest)) == mesh.castableFaces);
  }
}

TEST_CASE("which seeds are placed at random does not depend on how many of them are probes") {
  const PreparedMesh mesh = prepared(makeTorus(1000).mesh);
  Options options;
  options.sampler = "random";
  const SeedChoice without = chooseSeeds(mesh, options, shares(120, 0), {}, {});
  const SeedChoice with = chooseSeeds(mesh, options, shares(120, 30), {}, {});
  CHECK(without.probes.empty());
  CHECK(with.probes.size() == 30);
  CHECK(allOf(with) == without.placed);
  CHECK(allOf(chooseSeeds(mesh, options, shares(80, 20), with, {})) ==
        chooseSeeds(mesh, options, shares(80, 0), without, {}).placed);
}

TEST_CASE("probes are anywhere, also next to placed seeds") {
  // Blue noise keeps its distance; a probe that did too would lie where errors are greatest.
  const PreparedMesh mesh = prepared(makeSphere(2000).mesh);
  size_t touchingCount = 0;
  const SeedChoice choice = chooseSeeds(mesh, {}, shares(400, 100), {}, {});
  std::vector<uint8_t> isPlaced(2000, 0);
  for (const uint32_t face : choice.placed) isPlaced[face] = 1;
  const auto touches = [&](uint32_t face) {
    const auto neighbours = mesh.graph.neighboursOf(face);
    return std::any_of(neighbours.begin(), neighbours.end(), [&](uint32_t other) { return isPlaced[other] == 1; });
  };
  size_t touchingOfAll = 0, others = 0;
  for (const uint32_t face : choice.probes) touchingCount += touches(face);
  for (uint32_t face = 0; face < 2000; ++face)
    if (!isPlaced[face]) {
      ++others;
      touchingOfAll += touches(face);
    }
  const double share = static_cast<double>(touchingOfAll) / static_cast<double>(others);
  CHECK(static_cast<double>(touchingCount) / 100 == doctest::Approx(share).epsilon(0.3));
}

TEST_CASE("an adaptive choice is denser where the weight is great") {
  const PreparedMesh mesh = prepared(makeSphere(2000).mesh);
  std::vector<double> weight(2000, 0.01);
  const auto isUp = [&](uint32_t face) { return mesh.geometry.barycentres[face].z > 0; };
  for (uint32_t face = 0; face < 2000; ++face)
    if (isUp(face)) weight[face] = 1;
  Options options;
  options.sampler = "adaptive";
  const SeedChoice first = chooseSeeds(mesh, options, shares(50, 12), {}, {});
  const SeedChoice second = chooseSeeds(mesh, options, shares(100, 0), first, weight);
  CHECK(isAscendingWithoutRepeats(allOf(joined(first, second))));
  CHECK(std::count_if(second.placed.begin(), second.placed.end(), isUp) > 70);
}
