#include "estimate/held_out.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

using namespace asdfvk;

namespace {

std::vector<uint32_t> facesUpTo(uint32_t count) {
  std::vector<uint32_t> faces(count);
  std::iota(faces.begin(), faces.end(), 0u);
  return faces;
}

/// Share of the runs in which each face is sampled.
std::vector<double> shareSampled(std::span<const double> indicator, uint64_t count, uint32_t runCount) {
  std::vector<double> shares(indicator.size());
  const std::vector<uint32_t> faces = facesUpTo(static_cast<uint32_t>(indicator.size()));
  for (uint32_t run = 0; run < runCount; ++run)
    for (const uint32_t face : sampleHeldOut(faces, indicator, count, run).faces) shares[face] += 1.0 / runCount;
  return shares;
}

}  // namespace

TEST_CASE("held-out faces are as many as requested, all different, ascending and among the candidates") {
  std::vector<double> indicator(1000);
  for (size_t face = 0; face < 1000; ++face) indicator[face] = 0.1 + static_cast<double>(face * 7919 % 101);
  std::vector<uint32_t> candidates;
  for (uint32_t face = 0; face < 1000; face += 3) candidates.push_back(face);
  for (const uint64_t count : {0u, 1u, 2u, 50u, 300u, 333u, 334u, 5000u}) {
    const HeldOutFaces heldOut = sampleHeldOut(candidates, indicator, count, 5);
    CHECK(heldOut.faces.size() == std::min<uint64_t>(count, 334));
    CHECK(heldOut.weights.size() == heldOut.faces.size());
    CHECK(std::adjacent_find(heldOut.faces.begin(), heldOut.faces.end(), std::greater_equal<>()) ==
          heldOut.faces.end());
    CHECK(std::all_of(heldOut.faces.begin(), heldOut.faces.end(), [](uint32_t face) { return face % 3 == 0; }));
    CHECK(sampleHeldOut(candidates, indicator, count, 5).faces == heldOut.faces);
  }
  CHECK(sampleHeldOut(candidates, indicator, 50, 5).faces != sampleHeldOut(candidates, indicator, 50, 6).faces);
  CHECK(sampleHeldOut({}, indicator, 50, 5).faces.empty());
}

namespace {

/// Ten indicators. If four faces are sampled, the fifth is certain, and three are left for the others.
constexpr std::array<double, 10> kIndicator{1, 2, 3, 4, 100, 2, 4, 6, 8, 10};

std::vector<double> probabilitiesOfFour() {
  std::vector<double> densities;
  for (const double indicator : kIndicator) densities.push_back(std::pow(indicator, 9.0 / 8));
  const double sumOfOthers = std::accumulate(densities.begin(), densities.end(), 0.0) - densities[4];
  for (double& density : densities) density *= 3 / sumOfOthers;
  densities[4] = 1;
  return densities;
}

}  // namespace

TEST_CASE("the inclusion probability is in proportion to the power 9/8 of the indicator, and at most 1") {
  const std::vector<double> shares = shareSampled(kIndicator, 4, 20000), expected = probabilitiesOfFour();
  for (size_t face = 0; face < shares.size(); ++face)
    CHECK(shares[face] == doctest::Approx(expected[face]).epsilon(0.06));
}

TEST_CASE("a sampling weight is the number of other faces that a held-out face stands for") {
  const std::vector<uint32_t> faces = facesUpTo(10);
  const std::vector<double> probabilities = probabilitiesOfFour();
  for (uint64_t run = 0; run < 50; ++run) {
    const HeldOutFaces heldOut = sampleHeldOut(faces, kIndicator, 4, run);
    for (size_t i = 0; i < heldOut.faces.size(); ++i)
      CHECK(heldOut.weights[i] == doctest::Approx((1 / probabilities[heldOut.faces[i]] - 1) / 2.5));
  }
  for (const double weight : sampleHeldOut(faces, kIndicator, 10, 1).weights) CHECK(weight == 0);
}

TEST_CASE("held-out faces are the same in all units of length that differ by a power of two") {
  const std::vector<uint32_t> faces = facesUpTo(10);
  const HeldOutFaces expected = sampleHeldOut(faces, kIndicator, 4, 1);
  for (const double unit : {0x1p1, 0x1p500, 0x1p-500, 0x1p1000, 0x1p-1000}) {
    std::vector<double> scaled(kIndicator.begin(), kIndicator.end());
    for (double& indicator : scaled) indicator *= unit;
    const HeldOutFaces heldOut = sampleHeldOut(faces, scaled, 4, 1);
    CHECK(heldOut.faces == expected.faces);
    CHECK(heldOut.weights == expected.weights);
  }
}

TEST_CASE("indicators and represented counts belong to faces; a probability is in proportion to the count") {
  const std::vector<uint32_t> candidates{1, 3, 5, 7};
  const std::vector<double> indicator{9, 1, 9, 1, 9, 1, 9, 1};
  const std::vector<uint32_t> counts{9, 1, 9, 2, 9, 3, 9, 4};
  for (uint64_t run = 0; run < 50; ++run) {
    const HeldOutFaces heldOut = sampleHeldOut(candidates, indicator, 2, run, counts);
    REQUIRE(heldOut.faces.size() == 2);
    for (size_t i = 0; i < 2; ++i) {
      const double count = counts[heldOut.faces[i]], probability = 2 * count / 10;
      CHECK(heldOut.weights[i] == doctest::Approx((count / probability - 1) / 2));
    }
  }
}

TEST_CASE("the weighted sum over held-out faces estimates the sum over the other faces without bias") {
  std::vector<double> indicator(300), value(300);
  for (size_t face = 0; face < 300; ++face) {
    indicator[face] = 1 + static_cast<double>(face * 37 % 11);
    value[face] = indicator[face] + static_cast<double>(face % 5);
  }
  const double all = std::accumulate(value.begin(), value.end(), 0.0);
  const std::vector<uint32_t> faces = facesUpTo(300);
  double estimated = 0, real = 0;
  for (uint64_t run = 0; run < 400; ++run) {
    const HeldOutFaces heldOut = sampleHeldOut(faces, indicator, 60, run);
    real += all;
    for (size_t i = 0; i < 60; ++i) {
      estimated += heldOut.weights[i] * 5 * value[heldOut.faces[i]];
      real -= value[heldOut.faces[i]];
    }
  }
  CHECK(estimated == doctest::Approx(real).epsilon(0.01));
}

TEST_CASE("held-out faces of equal indicator are spread over the list") {
  const std::vector<double> indicator(1000, 1.0);
  const std::vector<uint32_t> faces = facesUpTo(1000);
  for (uint64_t run = 0; run < 20; ++run) {
    const std::vector<uint32_t> heldOut = sampleHeldOut(faces, indicator, 100, run).faces;
    for (uint32_t begin = 0; begin < 1000; begin += 100) {
      const auto count = std::count_if(heldOut.begin(), heldOut.end(),
                                       [&](uint32_t face) { return face >= begin && face < begin + 100; });
      CHECK(std::abs(count - 10) <= 1);
    }
  }
}
