#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "seeds/random_permutation.h"
#include "seeds/samplers.h"

using namespace asdfvk;

namespace {

std::vector<uint32_t> everyThirdFace(uint32_t count) {
  std::vector<uint32_t> faces(count);
  for (uint32_t i = 0; i < count; ++i) faces[i] = 3 * i + 1;
  return faces;
}

}  // namespace

TEST_CASE("any count of seeds is exact; they are distinct candidates, ascending") {
  const auto candidates = everyThirdFace(997);
  const std::set<uint32_t> allowed(candidates.begin(), candidates.end());
  for (uint64_t count : {0u, 1u, 2u, 99u, 100u, 500u, 996u, 997u}) {
    CAPTURE(count);
    const auto seeds = randomPermutationSeeds(candidates, count, 7);
    REQUIRE(seeds.size() == count);
    CHECK(std::adjacent_find(seeds.begin(), seeds.end(), std::greater_equal<>()) == seeds.end());
    CHECK(std::all_of(seeds.begin(), seeds.end(), [&](uint32_t face) { return allowed.contains(face); }));
  }
}

TEST_CASE("a count above the number of candidates gives all candidates, and no candidates give no seeds") {
  const auto candidates = everyThirdFace(5);
  CHECK(randomPermutationSeeds(candidates, 1'000'000'000'000u, 1) == candidates);
  CHECK(randomPermutationSeeds({}, 10, 1).empty());
}

TEST_CASE("seeds depend on the random seed and are reproducible") {
  const auto candidates = everyThirdFace(1000);
  // Computed by a separate program from the published SplitMix64 and Fisher-Yates.
  CHECK(randomPermutationSeeds(candidates, 5, 1) == std::vector<uint32_t>{700, 1027, 1102, 1516, 2782});
  CHECK(randomPermutationSeeds(candidates, 100, 1) != randomPermutationSeeds(candidates, 100, 2));
}

TEST_CASE("seeds are uniform over the candidates and not at regular indices") {
  std::vector<uint32_t> candidates(100'000);
  std::iota(candidates.begin(), candidates.end(), 0u);
  const auto seeds = randomPermutationSeeds(candidates, 10'000, 3);
  // The expected number is 1,000 per tenth of the faces, with a standard deviation of about 30.
  for (uint32_t tenth = 0; tenth < 10; ++tenth) {
    const auto inTenth = std::count_if(seeds.begin(), seeds.end(), [&](uint32_t f) { return f / 10'000 == tenth; });
    CHECK(inTenth > 850);
    CHECK(inTenth < 1150);
  }
  // Every n-th face of the mesh itself would give one gap only.
  std::set<uint32_t> gaps;
  for (size_t i = 1; i < seeds.size(); ++i) gaps.insert(seeds[i] - seeds[i - 1]);
  CHECK(gaps.size() > 20);
}
