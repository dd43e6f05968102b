#include "cone/cone.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "asdf_vk/error.h"

using namespace asdfvk;

namespace {

// The formula of the spiral as it is published, in its own order.
Vec3d vogelDirection(uint32_t i, uint32_t count, double halfAngle) {
  const double cosine = 1 - (i + 0.5) / count * (1 - std::cos(halfAngle));
  const double sine = std::sqrt(1 - cosine * cosine);
  const double phi = i * std::numbers::pi * (3 - std::sqrt(5.0));
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

}  // namespace

TEST_CASE("a cone holds exactly the rays of the golden-angle spiral, each once") {
  for (const uint32_t count : {1u, 2u, 7u, 30u, 64u, 333u, 1024u}) {
    for (const double degrees : {10.0, 120.0, 179.0}) {
      const Cone cone = makeCone({count, degrees});
      REQUIRE(cone.directions.size() == count);
      REQUIRE(cone.weights.size() == count);
      std::vector<int> matchCount(count, 0);
      for (uint32_t i = 0; i < count; ++i) {
        const Vec3d expected = vogelDirection(i, count, degrees * std::numbers::pi / 360);
        for (size_t k = 0; k < count; ++k) {
          if (length(cone.directions[k] - expected) > 1e-7) continue;
          ++matchCount[k];
          CHECK(cone.weights[k] * std::acos(expected.z) == doctest::Approx(1).epsilon(1e-6));
        }
      }
      CHECK(std::all_of(matchCount.begin(), matchCount.end(), [](int n) { return n == 1; }));
    }
  }
}

TEST_CASE("a cone of CGAL's definition holds exactly the rays of CGAL's disk, each once, with equal weights") {
  for (const uint32_t count : {1u, 2u, 12u, 25u, 64u, 333u}) {
    const Cone cone = makeCone({.rayCount = count, .definition = Definition::Cgal});
    REQUIRE(cone.directions.size() == count);
    CHECK(cone.weights == std::vector<double>(count, 1));
    std::vector<int> matchCount(count, 0);
    for (uint32_t i = 0; i < count; ++i) {
      const double radius = double(i) / count, phi = i * (3 - std::sqrt(5.0)) * std::numbers::pi;
      const double sine = std::sin(std::numbers::pi / 3), cosine = std::cos(std::numbers::pi / 3);
      const Vec3d onDisk{sine * radius * std::cos(phi), sine * radius * std::sin(phi), cosine};
      for (size_t k = 0; k < count; ++k) matchCount[k] += length(cone.directions[k] - onDisk / length(onDisk)) < 1e-12;
    }
    CHECK(std::all_of(matchCount.begin(), matchCount.end(), [](int n) { return n == 1; }));
  }
}

TEST_CASE("the solid angles of CGAL's rays are as their spiral fills the cone") {
  // The cap between the tangents r and r + dr of the angle to the axis has the solid angle 2 pi r dr (1 + r^2)^(-3/2).
  const uint32_t count = 400;
  const Cone cone = makeCone({.rayCount = count, .definition = Definition::Cgal});
  double sum = 0, inner = 0;
  for (uint32_t k = 0; k < count; ++k) {
    sum += cone.solidAngles[k];
    if (cone.directions[k].z > std::cos(0.5)) inner += cone.solidAngles[k];
  }
  CHECK(inner / sum == doctest::Approx((1 - std::cos(0.5)) / (1 - std::cos(std::numbers::pi / 3))).epsilon(0.02));
  CHECK(*std::min_element(cone.solidAngles.begin(), cone.solidAngles.end()) > 0);
}

TEST_CASE("a hit is false by the normals of both faces, or by the ray and the normal of the face hit") {
  const Cone paper = makeCone({}), cgal = makeCone({.definition = Definition::Cgal});
  const Vec3d seed{0, 0, -1}, axis{0, 0, 1}, oblique{0.6, 0, 0.8};
  for (const Vec3d& direction : {axis, oblique}) {
    CHECK_FALSE(isFalseHit(paper, seed, direction, axis));
    CHECK(isFalseHit(paper, seed, direction, -axis));
    CHECK_FALSE(isFalseHit(cgal, seed, direction, axis));
    CHECK(isFalseHit(cgal, seed, direction, -axis));
  }
  // A wall beside the seed that leans over it: the ray hits its inner side, but the normals are close.
  const Vec3d leaning{0.8, 0, -0.6 + 1e-3};
  CHECK(isFalseHit(paper, seed, oblique, leaning));
  CHECK_FALSE(isFalseHit(cgal, seed, oblique, leaning));
  CHECK(isFalseHit(cgal, seed, {1, 0, 0}, {0, 1, 0}));  // 90 degrees are not acute.
  CHECK(isFalseHit(cgal, seed, {1, 0, 0}, {-0.0, 1, 0}));
  CHECK_FALSE(isFalseHit(cgal, seed, {1, 0, 0}, {1e-30, 1, 0}));
}

TEST_CASE("all rays are unit vectors inside the cone") {
  const Cone cone = makeCone({1000, 90});
  for (const Vec3d& d : cone.directions) {
    CHECK(length(d) == doctest::Approx(1).epsilon(1e-14));
    CHECK(d.z > std::cos(std::numbers::pi / 4));
  }
}

TEST_CASE("rays are uniform in solid angle") {
  // Over the cap the mean of z is (1 + cos half) / 2, and that of x and y is 0.
  const Cone cone = makeCone({1024, 120});
  Vec3d sum;
  for (const Vec3d& d : cone.directions) sum += d;
  const Vec3d mean = sum / 1024.0;
  CHECK(mean.z == doctest::Approx(0.75).epsilon(1e-9));
  CHECK(std::abs(mean.x) < 2e-3);
  CHECK(std::abs(mean.y) < 2e-3);
  // A quarter of the azimuth holds a quarter of the rays.
  const auto inQuarter =
      std::count_if(cone.directions.begin(), cone.directions.end(), [](const Vec3d& d) { return d.x > 0 && d.y > 0; });
  CHECK(std::abs(inQuarter - 256) <= 5);
}

TEST_CASE("runs of eight rays are compact patches of the cone") {
  // Spread: the mean angle between the rays of a run and the run's mean direction, against that of the spiral's order.
  const auto spread = [](const std::vector<Vec3d>& directions) {
    double sum = 0;
    for (size_t begin = 0; begin < directions.size(); begin += 8) {
      const size_t end = std::min(begin + 8, directions.size());
      Vec3d mean;
      for (size_t i = begin; i < end; ++i) mean += directions[i];
      for (size_t i = begin; i < end; ++i) sum += std::acos(std::min(1.0, dot(directions[i], mean) / length(mean)));
    }
    return sum / static_cast<double>(directions.size());
  };
  for (const uint32_t count : {30u, 64u, 256u, 1024u}) {
    std::vector<Vec3d> spiral;
    for (uint32_t i = 0; i < count; ++i) spiral.push_back(vogelDirection(i, count, std::numbers::pi / 3));
    CHECK(spread(makeCone({count, 120}).directions) < (count == 30 ? 0.7 : 0.5) * spread(spiral));
  }
}

TEST_CASE("the first ray of the spiral has a finite weight even in the narrowest cone") {
  const Cone cone = makeCone({1, 1e-6});
  CHECK(cone.weights[0] * std::sqrt(0.5) * 0.5e-6 * std::numbers::pi / 180 == doctest::Approx(1));
}
