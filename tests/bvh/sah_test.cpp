#include "bvh/sah.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"

using namespace asdfvk;

namespace {

/// Boxes of size 0.1. lowerOf(i): the lower corner of box i; its last lane must be 0.
template <typename LowerOf>
std::vector<SplitTriangle> boxes(uint32_t count, const LowerOf& lowerOf) {
  std::vector<SplitTriangle> triangles;
  for (uint32_t i = 0; i < count; ++i) {
    const Float4 lower = lowerOf(i);
    triangles.emplace_back(SplitBox{lower, -(lower + Float4{0.1f, 0.1f, 0.1f, 0})}, i);
  }
  return triangles;
}

std::vector<uint32_t> facesOf(const std::vector<SplitTriangle>& triangles) {
  std::vector<uint32_t> faces;
  for (const SplitTriangle& triangle : triangles) faces.push_back(triangle.face());
  return faces;
}

/// The boxes on the left of the cheapest split between bins, by the definition: one split after another, without
/// vectors. Precondition: at most as many triangles as a sample.
std::vector<uint32_t> leftOfCheapestSplit(const std::vector<SplitTriangle>& triangles, uint32_t binCount) {
  const auto centre = [](const SplitTriangle& t, size_t axis) { return t.box.lower[axis] - t.box.negatedUpper[axis]; };
  const auto costOf = [](const std::vector<SplitTriangle>& side) {
    SplitBox box = SplitBox::empty();
    for (const SplitTriangle& triangle : side) box.grow(triangle.box);
    return box.halfArea() * static_cast<float>(side.size());
  };
  const uint32_t used = std::min(binCount, 4 + static_cast<uint32_t>(triangles.size()) / 4);
  float least = std::numeric_limits<float>::infinity();
  std::vector<uint32_t> best;
  for (size_t axis = 0; axis < 3; ++axis) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const SplitTriangle& triangle : triangles) {
      low = std::min(low, centre(triangle, axis));
      high = std::max(high, centre(triangle, axis));
    }
    if (!(high > low)) continue;
    const float factor = static_cast<float>(used) * (1 - 0x1p-20f) / (high - low);
    for (uint32_t bound = 1; bound < used; ++bound) {
      std::vector<SplitTriangle> left, right;
      for (const SplitTriangle& triangle : triangles)
        ((centre(triangle, axis) - low) * factor < static_cast<float>(bound) ? left : right).push_back(triangle);
      if (left.empty() || right.empty()) continue;
      const float cost = costOf(left) + costOf(right);
      if (cost >= least) continue;
      least = cost;
      best = facesOf(left);
    }
  }
  return best;
}

}  // namespace

TEST_CASE("two clusters are split between them, whatever the order of their triangles") {
  // More than the number of triangles in a sample. Every fifth triangle belongs to the cluster on the left.
  std::vector<SplitTriangle> triangles = boxes(5000, [](uint32_t i) {
    const float offset = 0.0001f * static_cast<float>(i);
    return i % 5 == 0 ? Float4{offset, 0, 0, 0} : Float4{10 + offset, offset, 0, 0};
  });
  const size_t leftCount = splitBySah(triangles, 16);
  REQUIRE(leftCount == 1000);
  const std::vector<uint32_t> faces = facesOf(triangles);
  CHECK(std::all_of(faces.begin(), faces.begin() + 1000, [](uint32_t face) { return face % 5 == 0; }));
  CHECK(std::none_of(faces.begin() + 1000, faces.end(), [](uint32_t face) { return face % 5 == 0; }));
}

TEST_CASE("triangles with equal centres are neither split nor reordered") {
  std::vector<SplitTriangle> triangles = boxes(40, [](uint32_t) { return Float4{1, 2, 3, 0}; });
  const std::vector<uint32_t> faces = facesOf(triangles);
  CHECK(splitBySah(triangles, 16) == 0);
  CHECK(facesOf(triangles) == faces);
}

TEST_CASE("the split is the cheapest of all splits between bins, on each axis") {
  Random random(8);
  const auto number = [&] { return static_cast<float>(random.real()); };
  std::array<int, 3> splitCount{};  // By the axis with the longest shape.
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    const auto count = 2 + static_cast<uint32_t>(random.index(60));
    const size_t longAxis = random.index(3);
    std::vector<SplitTriangle> triangles;
    for (uint32_t i = 0; i < count; ++i) {
      Float4 lower = {number(), number(), number(), 0}, size = {number(), 0.1f * number(), 0.3f * number(), 0};
      lower[longAxis] *= 4;
      // Clusters leave bins empty, and equal centres leave an axis without a split.
      if (round % 3 == 0) lower[longAxis] = std::floor(lower[longAxis]);
      if (round % 5 == 0) lower[(longAxis + 1) % 3] = size[(longAxis + 1) % 3] = 0.5f;
      triangles.emplace_back(SplitBox{lower, -(lower + size)}, i);
    }
    for (const uint32_t binCount : {2u, 7u, 32u}) {
      std::vector<SplitTriangle> split = triangles;
      const size_t leftCount = splitBySah(split, binCount);
      std::vector<uint32_t> left = facesOf({split.begin(), split.begin() + static_cast<std::ptrdiff_t>(leftCount)});
      std::sort(left.begin(), left.end());
      REQUIRE(left == leftOfCheapestSplit(triangles, binCount));
      splitCount[longAxis] += leftCount > 0 ? 1 : 0;
    }
  }
  for (const int splits : splitCount) CHECK(splits > 100);
}

TEST_CASE("splits are the same on every instruction set") {
  Random random(7);
  for (const uint32_t count : {2u, 9u, 64u, 1000u, 5000u})
    for (const uint32_t binCount : {2u, 16u, 32u}) {
      CAPTURE(count);
      CAPTURE(binCount);
      std::vector<SplitTriangle> plain = boxes(count, [&](uint32_t) {
        return Float4{static_cast<float>(random.real()), static_cast<float>(random.real()), 0.5f, 0};
      });
      std::vector<SplitTriangle> wide = plain;
      const size_t leftCount = splitBySah(plain, binCount, InstructionSet::Baseline);
      CHECK(leftCount > 0);
      CHECK(leftCount < count);
      CHECK(splitBySah(wide, binCount) == leftCount);
      CHECK(facesOf(wide) == facesOf(plain));
    }
}
