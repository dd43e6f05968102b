#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "cone/cone.h"
#include "core/random.h"

using namespace asdfvk;

namespace {

Vec3d randomUnit(Random& random) {
  for (;;) {
    const Vec3d p{2 * random.real() - 1, 2 * random.real() - 1, 2 * random.real() - 1};
    if (const double r = length(p); r > 0.1 && r < 1) return p / r;
  }
}

void checkFrame(const ConeFrame& frame, const Vec3d& axis) {
  CHECK(frame.axis == axis);
  CHECK(std::abs(length(frame.tangent) - 1) < 1e-14);
  CHECK(std::abs(length(frame.bitangent) - 1) < 1e-14);
  CHECK(std::abs(dot(frame.tangent, frame.bitangent)) < 1e-14);
  CHECK(std::abs(dot(frame.tangent, axis)) < 1e-14);
  CHECK(std::abs(dot(frame.bitangent, axis)) < 1e-14);
}

double handedness(const ConeFrame& frame) { return dot(cross(frame.tangent, frame.bitangent), frame.axis); }

double largestTurn(const Vec3d& a, const Vec3d& b) {
  const ConeFrame u = coneFrame(a), v = coneFrame(b);
  return std::max(length(u.tangent - v.tangent), length(u.bitangent - v.bitangent));
}

Vec3d withHeight(double z, double azimuth) {
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

// In turns, 0 to 1.
double turnOf(const Cone& cone, const Vec3d& normal, uint32_t face) {
  const ConeFrame fixed = coneFrame(-normal);
  const Vec3d tangent = paperConeFrame(cone, normal, face).tangent;
  const double turn = std::atan2(dot(tangent, fixed.bitangent), dot(tangent, fixed.tangent)) / (2 * std::numbers::pi);
  return turn < 0 ? turn + 1 : turn;
}

}  // namespace

TEST_CASE("frames are orthonormal and right-handed for every axis") {
  std::vector<Vec3d> axes = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {-0.0, -0.0, -1}};
  Random random(1);
  for (int i = 0; i < 2000; ++i) axes.push_back(randomUnit(random));
  for (const double z : {-0.7, std::nextafter(-0.7, -1.0), std::nextafter(-0.7, 1.0), -0.99999999, 1e-300, -1e-17})
    for (int i = 0; i < 16; ++i) axes.push_back(withHeight(z, 0.4 * i));
  for (const Vec3d& axis : axes) {
    checkFrame(coneFrame(axis), axis);
    CHECK(std::abs(handedness(coneFrame(axis)) - 1) < 1e-14);
  }
}

TEST_CASE("the straight-up and straight-down frames are the ones of the formula") {
  CHECK(coneFrame({0, 0, 1}).tangent == Vec3d{1, 0, 0});
  CHECK(coneFrame({0, 0, 1}).bitangent == Vec3d{0, 1, 0});
  CHECK(coneFrame({0, 0, -1}).tangent == Vec3d{1, 0, 0});
  CHECK(coneFrame({0, 0, -1}).bitangent == Vec3d{0, -1, 0});
}

TEST_CASE("frames do not turn over on upright walls, where the published ones do") {
  for (int i = 0; i < 64; ++i) {
    const double azimuth = 0.1 * i;
    CHECK(largestTurn(withHeight(1e-9, azimuth), withHeight(-1e-9, azimuth)) < 1e-8);
  }
}

TEST_CASE("frames are continuous everywhere but at an axis height of -0.7") {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const Vec3d axis = randomUnit(random);
    if (std::abs(axis.z + 0.7) < 1e-5) continue;
    const Vec3d moved = axis + Vec3d{1e-6 * random.real(), 1e-6 * random.real(), 1e-6 * random.real()};
    CHECK(largestTurn(axis, moved / length(moved)) < 1.2e-5);
  }
  CHECK(largestTurn(withHeight(-0.7 - 1e-9, 0.3), withHeight(-0.7 + 1e-9, 0.3)) > 0.1);
}

TEST_CASE("CGAL's frame begins with an axis at a coordinate of zero, else it drops the least coordinate") {
  const auto tangentOf = [](const Vec3d& inward) { return cgalConeFrame(inward).tangent; };
  CHECK(tangentOf({0, 0, 1}) == Vec3d{1, 0, 0});
  CHECK(tangentOf({-0.0, 2, 1}) == Vec3d{1, 0, 0});
  CHECK(tangentOf({7, 0, 0}) == Vec3d{0, 1, 0});
  CHECK(tangentOf({1, 0, -3}) == Vec3d{0, 1, 0});
  CHECK(tangentOf({1, -2, 0}) == Vec3d{0, 0, 1});
  CHECK(length(tangentOf({-1, 2, 3}) - Vec3d{0, -3, 2} / std::sqrt(13.0)) < 1e-15);
  CHECK(length(tangentOf({2, -1, 3}) - Vec3d{-3, 0, 2} / std::sqrt(13.0)) < 1e-15);
  CHECK(length(tangentOf({3, 2, -1}) - Vec3d{-2, 3, 0} / std::sqrt(13.0)) < 1e-15);
  CHECK(tangentOf({1, 1, 1}).x == 0);
  CHECK(tangentOf({2, -1, 1}).y == 0);
  CHECK(tangentOf({1, 3, -1}).x == 0);
  CHECK(tangentOf({1e-300, 1, 1}).x == 0);
  CHECK(cgalConeFrame({0, 0, 1}).bitangent == Vec3d{0, 1, 0});
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d axis = randomUnit(random);
    const ConeFrame frame = cgalConeFrame(axis * 1e3);
    CHECK(length(frame.axis - axis) < 1e-15);
    checkFrame(frame, frame.axis);
    CHECK(std::abs(handedness(frame) - 1) < 1e-14);
  }
}

TEST_CASE("the frame of a fixed cone depends on its axis only") {
  const Cone cone = makeCone({});
  Random random(3);
  for (uint32_t face = 0; face < 100; ++face) {
    const Vec3d normal = randomUnit(random);
    const ConeFrame frame = paperConeFrame(cone, normal, face), expected = coneFrame(-normal);
    CHECK(frame.tangent == expected.tangent);
    CHECK(frame.bitangent == expected.bitangent);
    CHECK(frame.axis == -normal);
  }
}

TEST_CASE("hashed frames are orthonormal and right-handed") {
  const Cone cone = makeCone({.rotation = ConeRotation::Hashed});
  Random random(4);
  for (uint32_t face = 0; face < 2000; ++face) {
    const Vec3d normal = randomUnit(random);
    const ConeFrame frame = paperConeFrame(cone, normal, face);
    checkFrame(frame, -normal);
    CHECK(std::abs(handedness(frame) - 1) < 1e-14);
  }
}

TEST_CASE("hashed frames are turned by SplitMix64 of the face, evenly and independently of the face before") {
  const Cone cone = makeCone({.rotation = ConeRotation::Hashed});
  const Vec3d normal{0.48, -0.6, 0.64};
  // The published first output of SplitMix64 for a seed of 0.
  CHECK(turnOf(cone, normal, 0) == doctest::Approx(double(0xe220a8397b1dcdafu) * 0x1p-64).epsilon(1e-12));
  constexpr uint32_t kFaceCount = 16'000;
  std::array<uint32_t, 16> turnCounts{}, changeCounts{};
  double before = turnOf(cone, normal, kFaceCount);
  for (uint32_t face = 0; face < kFaceCount; ++face) {
    const double turn = turnOf(cone, normal, face);
    ++turnCounts[static_cast<size_t>(turn * 16) % 16];
    ++changeCounts[static_cast<size_t>((turn - before + 1) * 16) % 16];
    before = turn;
  }
  for (size_t i = 0; i < 16; ++i) {  // 1000 expected, with a standard deviation of 31
    CHECK(std::abs(int(turnCounts[i]) - 1000) < 130);
    CHECK(std::abs(int(changeCounts[i]) - 1000) < 130);
  }
}
