#include "segment/part_consensus.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace asdfvk;

namespace {

using Labels = std::vector<uint32_t>;

constexpr double kThreshold = 0.05;

/// Faces in a row, of equal area and without arcs.
PartSurface rowOfFaces(uint32_t count) {
  PartSurface surface;
  surface.areas.assign(count, 1.0f / static_cast<float>(count));
  return surface;
}

/// Each face is a patch. Neighbouring patches i and i + 1 differ by steps[i] of the logarithm of the value.
Division rowOfPatches(const std::vector<double>& steps) {
  Division division;
  const double area = 1 / static_cast<double>(steps.size() + 1);
  double logValue = 0;
  for (uint32_t i = 0; i <= steps.size(); ++i) {
    division.patches.patchOf.push_back(i);
    division.data.patches.push_back({area, logValue, {0.3 * i, 0, 0}, {0, 0, 1}, i});
    if (i == steps.size()) break;
    division.data.borders.push_back({i, i + 1, 0.1, 0, 0});
    logValue += steps[i];
  }
  division.patches.count = static_cast<uint32_t>(division.data.patches.size());
  division.merging.emplace(division.data, SightMatrix(division.patches.count), kSightWeights);
  return division;
}

}  // namespace

TEST_CASE("boundaries that more than half of the variants have remain") {
  const PartSurface surface = rowOfFaces(6);
  const Division split = rowOfPatches({0, 0, 1.5, 0, 0}), whole = rowOfPatches({0, 0, 0, 0, 0});
  const auto labelsOf = [&](std::vector<Division> divisions) {
    PartConsensus consensus(surface, divisions, kThreshold);
    consensus.mergeUpTo(0.5);
    return consensus.regionOfPatches();
  };
  CHECK(labelsOf({split}) == Labels{0, 0, 0, 1, 1, 1});
  CHECK(labelsOf({split, whole, split}) == Labels{0, 0, 0, 1, 1, 1});
  CHECK(labelsOf({whole, split, whole}) == Labels{0, 0, 0, 0, 0, 0});
}

TEST_CASE("the stability is the share of divisions and thresholds that separate two regions") {
  const PartSurface surface = rowOfFaces(2);
  const Division pair = rowOfPatches({1});
  const double cost = pair.merging->nextCost().value();
  const auto stabilityAt = [&](double threshold) {
    const std::vector<Division> divisions{pair, pair};
    return PartConsensus(surface, divisions, threshold).stability(0, 1);
  };
  CHECK(stabilityAt(cost) == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(stabilityAt(cost * std::exp(-0.5)) == doctest::Approx(0.75).epsilon(1e-6));
  CHECK(stabilityAt(cost * std::exp(0.5)) == doctest::Approx(0.25).epsilon(1e-6));
  CHECK(stabilityAt(cost / 10) == 1);
  CHECK(stabilityAt(cost * 10) == 0);

  const std::vector<Division> mixed{rowOfPatches({5}), rowOfPatches({0})};
  // The first division costs twice as much as `pair`, because steps are limited; the second one never separates.
  CHECK(PartConsensus(surface, mixed, cost).stability(0, 1) == doctest::Approx((std::log(2) + 1) / 4).epsilon(1e-5));
}

TEST_CASE("patches of other divisions count by their overlap") {
  const PartSurface surface = rowOfFaces(4);
  Division coarse = rowOfPatches({3});  // Faces 0 to 2 are its first patch, face 3 is its second one.
  coarse.patches.patchOf = {0, 0, 0, 1};
  const std::vector<Division> divisions{coarse, rowOfPatches({0, 0, 0})};
  const PartConsensus consensus(surface, divisions, kThreshold);
  CHECK(consensus.stability(0, 2) == 0);
  CHECK(consensus.stability(2, 3) == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("merging to a count, of small regions, and of components") {
  const PartSurface surface = rowOfFaces(4);
  Division division = rowOfPatches({0.5, 2, 1});
  const auto consensusOf = [&] { return PartConsensus(surface, {&division, 1}, 8); };  // Near the costs of the steps.
  PartConsensus two = consensusOf();
  two.mergeToCount(2);
  CHECK(two.regionOfPatches() == Labels{0, 0, 1, 1});
  const PartConsensus copy = two;
  two.mergeToCount(0);
  CHECK(two.regionCount() == 1);
  CHECK(copy.regionCount() == 2);

  PartConsensus large = consensusOf();
  large.mergeSmallerThan(0.3);
  CHECK(large.regionOfPatches() == Labels{0, 0, 1, 1});

  division.data.borders.erase(division.data.borders.begin() + 1);
  division.merging.emplace(division.data, SightMatrix(4), kSightWeights);
  PartConsensus apart = consensusOf();
  apart.mergeUpTo(1);
  CHECK(apart.regionOfPatches() == Labels{0, 0, 1, 1});
  apart.mergeSmallerThan(1);
  CHECK(apart.regionCount() == 2);
  CHECK(apart.stability(0, 3) == 1);
}
