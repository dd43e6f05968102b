#include "mesh/input_faces.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"

using namespace asdfvk;

namespace {

std::vector<Face> triangulated(const std::vector<Vec3d>& vertices) {
  std::vector<uint32_t> corners(vertices.size());
  for (uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  std::vector<Face> triangles(corners.size() - 2);
  PolygonTriangulator().triangulate(vertices, corners, triangles);
  return triangles;
}

Vec3d areaVector(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return cross(b - a, c - a) * 0.5; }

/// A cut without overlap: all triangles have the winding of the polygon, and their areas add up to its area.
void requireExactCover(const std::vector<Vec3d>& vertices) {
  Vec3d polygonArea;
  for (size_t i = 1; i + 1 < vertices.size(); ++i)
    polygonArea = polygonArea + areaVector(vertices[0], vertices[i], vertices[i + 1]);
  double sum = 0;
  for (const Face& face : triangulated(vertices)) {
    const Vec3d area = areaVector(vertices[face[0]], vertices[face[1]], vertices[face[2]]);
    CHECK(dot(area, polygonArea) >= -1e-12 * dot(polygonArea, polygonArea));
    sum += length(area);
  }
  CHECK(sum == doctest::Approx(length(polygonArea)).epsilon(1e-9));
}

/// The polygon rotated out of its plane, scaled, shifted; in both windings and from each first corner.
void requireExactCoverEverywhere(const std::vector<Vec3d>& polygon) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    std::vector<Vec3d> moved;
    for (const Vec3d& p : polygon)
      moved.push_back(
          Vec3d{0.36 * p.x + 0.48 * p.y - 0.8 * p.z, -0.8 * p.x + 0.6 * p.y, 0.48 * p.x + 0.64 * p.y + 0.6 * p.z} *
              scale +
          Vec3d{5, -7, 11} * scale);
    for (size_t i = 0; i < moved.size(); ++i) {
      requireExactCover(moved);
      requireExactCover({moved.rbegin(), moved.rend()});
      std::rotate(moved.begin(), moved.begin() + 1, moved.end());
    }
  }
}

}  // namespace

TEST_CASE("a convex polygon becomes the fan of its first corner") {
  CHECK(triangulated({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == std::vector<Face>{{0, 1, 2}});
  CHECK(triangulated({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == std::vector<Face>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("concave polygons are cut without overlap in any plane, winding, size and from any first corner") {
  requireExactCoverEverywhere({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}});
  requireExactCoverEverywhere({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  std::vector<Vec3d> star;
  for (int i = 0; i < 24; ++i) {
    const double angle = i * std::numbers::pi / 12, radius = i % 2 == 0 ? 1 : 0.3;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  requireExactCoverEverywhere(star);
  std::vector<Vec3d> comb = {{20, 5, 0}, {0, 5, 0}};
  for (int i = 0; i < 20; ++i) comb.push_back({i + 0.5, i % 2 == 0 ? 4.5 : 0.0, 0});
  requireExactCoverEverywhere(comb);
}

TEST_CASE("polygons with a hole, joined by an edge that occurs twice, are cut without overlap") {
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    const uint32_t count = 3 + random.index(12);
    std::vector<Vec3d> outer, hole;
    for (uint32_t i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      const Vec3d direction = {std::cos(angle), std::sin(angle), 0};
      // Below half of the outer radius times cos(60 degrees), so that no edge of the two rings can cross.
      outer.push_back(direction * (0.5 + 0.5 * random.real()));
      hole.push_back(direction * (0.02 + 0.18 * random.real()));
    }
    std::vector<Vec3d> polygon(outer.begin(), outer.end());
    polygon.push_back(outer[0]);
    polygon.push_back(hole[0]);
    polygon.insert(polygon.end(), hole.rbegin(), hole.rend());
    std::rotate(polygon.begin(), polygon.begin() + random.index(static_cast<uint32_t>(polygon.size())), polygon.end());
    requireExactCover(polygon);
  }
}

TEST_CASE("a straight corner gives no triangle without area") {
  const std::vector<Vec3d> vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};
  for (const Face& face : triangulated(vertices))
    CHECK(length(areaVector(vertices[face[0]], vertices[face[1]], vertices[face[2]])) > 0.1);
}

TEST_CASE("degenerate polygons still give all their triangles") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<Face> fan = {{0, 1, 2}, {0, 2, 3}};
  CHECK(triangulated({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}) == fan);
  CHECK(triangulated({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}) == fan);
  CHECK(triangulated({{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == fan);
  CHECK(triangulated({{0, 0, 0}, {inf, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == fan);
  CHECK(triangulated({{-1e308, 0, 0}, {1e308, 0, 0}, {1e308, 1, 0}, {0, 1, 0}}) == fan);
  // A pentagram crosses itself.
  std::vector<Vec3d> pentagram;
  for (int i = 0; i < 5; ++i)
    pentagram.push_back({std::cos(i * 0.8 * std::numbers::pi), std::sin(i * 0.8 * std::numbers::pi), 0});
  CHECK(triangulated(pentagram).size() == 3);
}

TEST_CASE("a polygon with more than kMaxEarClippedCorners becomes a fan") {
  std::vector<Vec3d> zigzag;
  for (size_t i = 0; i < 1000000; ++i) zigzag.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 1.0, 0});
  const std::vector<Face> triangles = triangulated(zigzag);
  CHECK(triangles.front() == Face{0, 1, 2});
  CHECK(triangles.back() == Face{0, 999998, 999999});
}
