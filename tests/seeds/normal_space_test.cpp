#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/random.h"
#include "generate/analytic_shapes.h"
#include "seeds/normal_space.h"
#include "seeds/samplers.h"
#include "seeds/surface.h"

using namespace asdfvk;

namespace {

using BinCounts = std::array<uint64_t, kNormalBinCount>;

BinCounts countsOf(const Surface& surface, std::span<const uint32_t> faces) {
  BinCounts counts{};
  for (uint32_t face : faces) ++counts[normalBinOf(surface.geometry.normals[face])];
  return counts;
}

Vec3d randomDirection(Random& random) {
  for (;;) {
    const Vec3d point{2 * random.real() - 1, 2 * random.real() - 1, 2 * random.real() - 1};
    const double radius = length(point);
    if (radius > 0.1 && radius < 1) return point / radius;
  }
}

}  // namespace

TEST_CASE("the bins of directions differ in size by less than a factor of 2, and each is compact") {
  Random random(1);
  std::array<int, kNormalBinCount> counts{};
  std::array<Vec3d, kNormalBinCount> firstIn{};
  const int directionCount = 486'000;  // 1000 per bin.
  for (int i = 0; i < directionCount; ++i) {
    const Vec3d direction = randomDirection(random);
    const uint32_t bin = normalBinOf(direction);
    REQUIRE(bin < kNormalBinCount);
    if (counts[bin]++ == 0) firstIn[bin] = direction;
    CHECK(dot(direction, firstIn[bin]) > std::cos(0.3));
  }
  CHECK(*std::min_element(counts.begin(), counts.end()) > 700);
  CHECK(*std::max_element(counts.begin(), counts.end()) < 1400);
}

TEST_CASE("each axis and its neighbourhood are in one bin of their own") {
  std::set<uint32_t> bins;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (double sign : {1.0, -1.0}) {
      Vec3d normal;
      normal[axis] = sign;
      bins.insert(normalBinOf(normal));
      for (double tilt : {-1e-3, 1e-3}) {
        Vec3d tilted = normal;
        tilted[(axis + 1) % 3] = tilt;
        tilted[(axis + 2) % 3] = -tilt;
        CHECK(normalBinOf(tilted) == normalBinOf(normal));
      }
    }
  }
  CHECK(bins.size() == 6);
}

TEST_CASE("each side of a long box gets the same number of seeds") {
  const Surface box(makeBox(20'000, {1, 1, 10}).mesh);
  std::set<uint64_t> perSide;
  for (uint64_t count : countsOf(box, normalSpaceSeeds(box.domain(), 600, {}, 1)))
    if (count > 0) perSide.insert(count);
  CHECK(perSide == std::set<uint64_t>{100});
}

TEST_CASE("the bins with enough faces have equal numbers of seeds, except for one seed each") {
  const Surface& cylinder = generatedSurface("cylinder", 6000);
  const BinCounts available = countsOf(cylinder, cylinder.candidates);
  for (uint64_t count : {10u, 333u, 3000u, 5000u}) {
    CAPTURE(count);
    const BinCounts chosen = countsOf(cylinder, normalSpaceSeeds(cylinder.domain(), count, {}, 1));
    const uint64_t most = *std::max_element(chosen.begin(), chosen.end());
    for (uint32_t bin = 0; bin < kNormalBinCount; ++bin)
      CHECK((chosen[bin] == available[bin] || chosen[bin] + 1 >= most));
  }
}

TEST_CASE("existing seeds count in their bin") {
  const Surface box(makeBox(6000, {1, 1, 1}).mesh);
  std::vector<uint32_t> existing;  // 100 on one side, 50 on another.
  const auto sideOf = [&](uint32_t face) { return normalBinOf(box.geometry.normals[face]); };
  const auto take = [&](const Vec3d& normal, size_t count) {
    for (uint32_t face : box.candidates) {
      if (count == 0) break;
      if (sideOf(face) != normalBinOf(normal)) continue;
      existing.push_back(face);
      --count;
    }
  };
  take({1, 0, 0}, 100);
  take({0, 0, -1}, 50);
  std::vector<uint32_t> all = normalSpaceSeeds(box.domain(), 4 * 80 + 30, existing, 1);
  const BinCounts fresh = countsOf(box, all);
  CHECK(fresh[normalBinOf({1, 0, 0})] == 0);
  CHECK(fresh[normalBinOf({0, 0, -1})] == 30);
  for (const Vec3d& normal : {Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}})
    CHECK(fresh[normalBinOf(normal)] == 80);
}
