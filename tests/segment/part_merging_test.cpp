#include "segment/part_merging.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace asdfvk;

namespace {

using Labels = std::vector<uint32_t>;

/// Patches in a row, each adjacent to the next, of the areas and logarithms of values.
PatchData chain(const std::vector<double>& areas, const std::vector<double>& logValues) {
  PatchData data;
  for (size_t i = 0; i < areas.size(); ++i) {
    data.patches.push_back({areas[i], logValues[i], {0.3 * static_cast<double>(i), 0, 0}, {0, 0, 1}, 0});
    if (i > 0) data.borders.push_back({static_cast<uint32_t>(i) - 1, static_cast<uint32_t>(i), 0.1, 0, 0});
  }
  return data;
}

PartMerging merging(const PatchData& data, const MergeWeights& weights = kSightWeights) {
  return {data, SightMatrix(static_cast<uint32_t>(data.patches.size())), weights};
}

double costOfPair(const PatchData& data, const SightMatrix& sight, const MergeWeights& weights) {
  return PartMerging(data, sight, weights).nextCost().value();
}

}  // namespace

TEST_CASE("the cost of two patches is that of the formula") {
  PatchData data;
  const double l = std::log(0.2);
  data.patches.push_back({0.04, l, {0, 0, 0}, {0, 0, 1}, 0});
  data.patches.push_back({0.09, l + 0.4, {0.1, 0, 0}, {std::sin(0.3), 0, std::cos(0.3)}, 0});  // Convex: turned away.
  data.borders.push_back({0, 1, 0.15, 0.15 * 0.2, 0.15 * 0.05});
  const double shape = 0.5 * 0.4 + 0.15 * 0.4 + 3 * 0.15 - 0.18 * 0.3;
  const auto factor = [](const MergeWeights& w) {
    return std::pow(0.04, w.areaExponent) * std::pow(0.15 / 0.2, w.borderExponent);
  };
  SightMatrix clear(2), blocked(2);
  blocked.set(0, 1, 0);
  CHECK(costOfPair(data, clear, kSightWeights) == doctest::Approx(shape * factor(kSightWeights)).epsilon(1e-6));
  CHECK(costOfPair(data, blocked, kSightWeights) ==
        doctest::Approx((shape + 0.45) * factor(kSightWeights)).epsilon(1e-6));
  const double other = 0.5 * 0.4 + 0.2 * 0.4 + 4.25 * 0.15 - 0.15 * 0.3;
  CHECK(costOfPair(data, blocked, kShapeWeights) == doctest::Approx(other * factor(kShapeWeights)).epsilon(1e-6));

  // Concave, and more than the limits.
  data.patches[1].normal = {-std::sin(1.0), 0, std::cos(1.0)};
  data.patches[1].logValue = l + 5;
  data.borders[0].concave = 0.15 * 2;
  const double steep = 0.5 * 2 + 0.15 * 2 + 3 * 0.55 + 0.9 * 0.55;
  CHECK(costOfPair(data, clear, kSightWeights) == doctest::Approx(steep * factor(kSightWeights)).epsilon(1e-6));
}

TEST_CASE("a neck between regions raises the cost") {
  // Merged first, patches 0 and 1 are one region whose border with 2 is thinner than both.
  PatchData data = chain({0.3, 0.02, 0.3}, {0, -0.3, 0});
  PartMerging thin = merging(data);
  thin.mergeToCount(2);
  data.patches[1].logValue = 0;
  PartMerging even = merging(data);
  even.mergeToCount(2);
  CHECK(*thin.nextCost() > 2 * *even.nextCost());
}

TEST_CASE("a threshold stops before the largest step, a count exactly there") {
  const PatchData data = chain({0.1, 0.1, 0.1, 0.1, 0.1, 0.1}, {0, 0.01, 0.02, 1.5, 1.51, 1.52});
  PartMerging byCost = merging(data);
  byCost.mergeUpTo(0.1);
  CHECK(byCost.regionOfPatches() == Labels{0, 0, 0, 1, 1, 1});
  CHECK(byCost.merges().size() == 4);
  for (const PartMerging::Merge& merge : byCost.merges()) CHECK(merge.cost <= 0.1);
  CHECK(*byCost.nextCost() > 0.1);
  PartMerging byCount = merging(data);
  byCount.mergeToCount(2);
  CHECK(byCount.regionOfPatches() == byCost.regionOfPatches());
  const PartMerging copy = byCount;
  byCount.mergeToCount(0);
  CHECK(byCount.regionCount() == 1);
  CHECK_FALSE(byCount.nextCost().has_value());
  CHECK(copy.regionCount() == 2);
}

TEST_CASE("regions without a common border are never merged") {
  PatchData data = chain({0.2, 0.2, 0.2, 0.2}, {0, 0, 0, 0});
  data.borders.erase(data.borders.begin() + 1);
  PartMerging regions = merging(data);
  regions.mergeToCount(1);
  CHECK(regions.regionOfPatches() == Labels{0, 0, 1, 1});
}

TEST_CASE("each level refines the next one") {
  std::vector<double> areas, logs;
  for (int i = 0; i < 30; ++i) {
    areas.push_back(0.01 + 0.001 * (i % 7));
    logs.push_back(std::sin(i * 0.7));
  }
  PartMerging levels = merging(chain(areas, logs));
  Labels finer = levels.regionOfPatches();
  while (levels.nextCost()) {
    levels.mergeToCount(levels.regionCount() - 1);
    const Labels coarser = levels.regionOfPatches();
    for (size_t i = 0; i < finer.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (finer[i] == finer[j]) CHECK(coarser[i] == coarser[j]);
    finer = coarser;
  }
  CHECK(levels.regionCount() == 1);
}

TEST_CASE("one patch, and patches without area or border length") {
  PartMerging one = merging(chain({1}, {0}));
  CHECK_FALSE(one.nextCost().has_value());
  CHECK(one.regionOfPatches() == Labels{0});
  PatchData data = chain({0.5, 0, 0.5}, {0, 0, 2});
  data.borders[1].length = 0;
  PartMerging flat = merging(data);
  CHECK(*flat.nextCost() == 0);
  flat.mergeToCount(1);
  CHECK(flat.regionCount() == 1);
}
