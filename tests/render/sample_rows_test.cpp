#include "render/sample_rows.h"

#include <doctest/doctest.h>

#include <random>

namespace asdfvk {
namespace {

using Corners = std::array<Projected, 3>;

std::vector<Corners> randomTriangles(size_t count, double size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 90), offset(-size, size), depth(-1, 1);
  std::vector<Corners> triangles(count);
  for (Corners& corners : triangles) {
    const double x = place(random), y = place(random);
    for (Projected& corner : corners) corner = {x + offset(random), y + offset(random), depth(random)};
  }
  return triangles;
}

/// The nearest triangle at a place, by its barycentric coordinates, and its depth.
std::pair<uint32_t, double> nearestAt(const std::vector<Corners>& triangles, const Point2& place) {
  std::pair<uint32_t, double> nearest{kNoSample, -1e300};
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const auto [ofA, ofB, ofC] = cornerShares(triangles[i], place);
    const double depth = ofA * a.depth + ofB * b.depth + ofC * c.depth;
    if (ofA >= 0 && ofB >= 0 && ofC >= 0 && depth > nearest.second) nearest = {i, depth};
  }
  return nearest;
}

TEST_CASE("a sample has the nearest triangle") {
  for (const int perSide : {1, 4})
    for (const double size : {1.0, 15.0, 200.0}) {
      const std::vector<Corners> triangles = randomTriangles(300, size);
      SampleRows rows(80, 8, 72, perSide);
      for (uint32_t i = 0; i < triangles.size(); ++i) rows.draw(i, triangles[i]);
      for (int row = 8; row < 72; ++row)
        for (int column = 0; column < 80; ++column) {
          const std::pair<uint32_t, double> nearest = nearestAt(triangles, rows.placeOf(column, row));
          CHECK_EQ(rows.indexAt(column, row), nearest.first);
          if (nearest.first == kNoSample) continue;
          CHECK_EQ(rows.depthAt(column, row), doctest::Approx(nearest.second).epsilon(1e-5));
        }
    }
}

TEST_CASE("the two triangles of an edge leave no sample between them") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 64);
  for (int i = 0; i < 200; ++i) {
    const Projected low{place(random), -10, 0}, high{place(random), 80, 0};
    SampleRows rows(64, 0, 64);
    rows.draw(0, {low, high, {-900, 20, 0}});
    rows.draw(1, {high, low, {900, 20, 0}});
    for (int row = 0; row < 64; ++row)
      for (int column = 0; column < 64; ++column) CHECK_NE(rows.indexAt(column, row), kNoSample);
  }
}

TEST_CASE("boxes behind all samples are hidden, others are not") {
  SampleRows rows(64, 0, 64);
  const SampleBox behind{10, 10, 50, 50, -0.5}, before{10, 10, 50, 50, 0.5}, outside{70, 10, 90, 50, 0.5};
  CHECK_FALSE(rows.hides(behind));
  CHECK(rows.hides(outside));
  rows.draw(0, {{{-100, -100, 0}, {300, -100, 0}, {-100, 300, 0}}});
  CHECK(rows.hides(behind));
  CHECK_FALSE(rows.hides(before));
}

}  // namespace
}  // namespace asdfvk
