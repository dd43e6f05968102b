#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stop_token>
#include <vector>

#include "asdf_vk/run_control.h"
#include "asdf_vk/scene.h"
#include "core/random.h"
#include "generate/shapes.h"
#include "generate/surface_nets.h"
#include "generate/thickness_parts.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"

// Scene::distance(), radii() and firstHits().

using namespace asdfvk;
using test::referenceSession;
using test::requireFailure;

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// The distance of a point to a triangle in barycentric coordinates; infinite where it has no area.
double triangleDistance(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  const Vec3d u = b - a, v = c - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  if (!(determinant > 1e-12 * uu * vv)) return kNone;
  const double s = (vv * dot(w, u) - uv * dot(w, v)) / determinant, t = (uu * dot(w, v) - uv * dot(w, u)) / determinant;
  if (s >= 0 && t >= 0 && s + t <= 1) return length(w - s * u - t * v);
  double least = kNone;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const Vec3d edge = to - from;
    least = std::min(least, length(p - from - std::clamp(dot(p - from, edge) / dot(edge, edge), 0.0, 1.0) * edge));
  }
  return least;
}

double bruteDistance(const Mesh& mesh, const Vec3d& p) {
  double least = kNone;
  for (const auto& [a, b, c] : mesh.faces)
    least = std::min(least, triangleDistance(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], p));
  return least;
}

/// The winding number of the surface around a point, by solid angles (Van Oosterom and Strackee 1983).
double windingNumber(const Mesh& mesh, const Vec3d& p) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.faces) {
    const Vec3d a = mesh.vertices[i] - p, b = mesh.vertices[j] - p, c = mesh.vertices[k] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

/// In the bounding box of the mesh, enlarged; some at vertices and on faces.
std::vector<double> pointsAround(const Mesh& mesh, size_t count, uint64_t seed) {
  Random random(seed);
  Vec3d low = mesh.vertices[0], high = low;
  for (const Vec3d& v : mesh.vertices)
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], v[axis]);
      high[axis] = std::max(high[axis], v[axis]);
    }
  std::vector<double> points;
  for (size_t i = 0; i < count; ++i) {
    const auto& [a, b, c] = mesh.faces[random.index(mesh.faces.size())];
    Vec3d p = mesh.vertices[a];
    if (i % 8 == 1) p = 0.5 * mesh.vertices[a] + 0.3 * mesh.vertices[b] + 0.2 * mesh.vertices[c];
    if (i % 8 > 1)
      for (size_t axis = 0; axis < 3; ++axis)
        p[axis] = low[axis] + (1.4 * random.real() - 0.2) * (high[axis] - low[axis]);
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  return points;
}

Vec3d at(const std::vector<double>& points, size_t i) { return {points[3 * i], points[3 * i + 1], points[3 * i + 2]}; }

}  // namespace

TEST_CASE("the distance is that of brute force, also beside degenerate faces") {
  Mesh withDegenerate = shapes::jittered(shapes::icosphere(2), 0.1, 3);
  withDegenerate.vertices.push_back({3, 0, 0});  // A needle and a repeated corner, outside of the sphere.
  withDegenerate.faces.push_back({0, 162, 162});
  withDegenerate.faces.push_back({162, 0, 162});
  for (const Mesh& mesh : {shapes::soup(150, 5), withDegenerate, makeThicknessPart("pocket").solid.surface(),
                           shapes::scaledAndShifted(shapes::soup(80, 6), 1e-9, {1e-7, 2e-7, 0})}) {
    CAPTURE(mesh.faces.size());
    Scene scene(referenceSession(), mesh);
    const std::vector<double> points = pointsAround(mesh, 200, 9), found = scene.distance(points);
    REQUIRE(found.size() == 200);
    const double size = *std::max_element(found.begin(), found.end());
    for (size_t i = 0; i < found.size(); ++i)
      CHECK(std::abs(found[i] - bruteDistance(mesh, at(points, i))) <= 1e-6 * size);
  }
}

TEST_CASE("the radius is the distance inside, by the winding number, and NaN outside") {
  const Mesh hollow = shapes::joined(shapes::box({3, 4, 5}, 3), shapes::inverted(shapes::box({2, 2, 2}, 2)));
  for (const Mesh& mesh : {makeTorus(600).mesh, hollow, makeHand(500).mesh, shapes::jittered(hollow, 0.1, 3),
                           makeThicknessPart("sharp-thread").solid.surface()}) {
    CAPTURE(mesh.faces.size());
    Scene scene(referenceSession(), mesh);
    const std::vector<double> points = pointsAround(mesh, 400, 4), radii = scene.radii(points);
    const std::vector<double> distances = scene.distance(points);
    const double size = *std::max_element(distances.begin(), distances.end());
    size_t insideCount = 0;
    for (size_t i = 0; i < radii.size(); ++i) {
      if (distances[i] < 1e-9 * size) {  // On the surface.
        CHECK((std::isnan(radii[i]) || radii[i] == distances[i]));
        continue;
      }
      const bool isInside = windingNumber(mesh, at(points, i)) > 0.5;
      CHECK(std::isnan(radii[i]) != isInside);
      if (isInside) CHECK(radii[i] == distances[i]);
      insideCount += isInside ? 1 : 0;
    }
    CHECK(insideCount > 20);
  }
  const Mesh inverted = shapes::inverted(shapes::cube());
  Scene flipped(referenceSession(), inverted, Orientation::Flip), kept(referenceSession(), inverted);
  CHECK(flipped.radii(std::array{0.1, 0.0, 0.0}).front() == doctest::Approx(0.9));
  CHECK(std::isnan(kept.radii(std::array{0.1, 0.0, 0.0}).front()));
}

TEST_CASE("parts that overlap or touch are one shape") {
  const Mesh ball = shapes::icosphere(3, 5), box = shapes::box({2, 2, 2});
  const Mesh overlapping = shapes::joined(ball, ball, {6, 0, 0}), touching = shapes::joined(box, box, {2, 0, 0});
  Scene balls(referenceSession(), overlapping), boxes(referenceSession(), touching);
  const std::vector<double> inBalls =
      balls.radii(std::array{0.0, 0.0, 0.0, 6.0, 0.0, 0.0, 3.0, 0.0, 0.0, 3.0, 4.2, 0.0});
  CHECK(inBalls[0] == doctest::Approx(5).epsilon(0.01));
  CHECK(inBalls[1] == doctest::Approx(5).epsilon(0.01));
  CHECK(inBalls[2] == doctest::Approx(4).epsilon(0.01));  // To the circle in which the spheres cross.
  CHECK(std::isnan(inBalls[3]));
  const std::vector<double> inBoxes = boxes.radii(std::array{0.9, 0.0, 0.0, 1.0, 0.5, 0.0, 3.1, 0.0, 0.0});
  CHECK(inBoxes[0] == doctest::Approx(1));
  CHECK(inBoxes[1] == doctest::Approx(0.5));
  CHECK(std::isnan(inBoxes[2]));
  const std::vector<double> thickness = boxes.thicknessAt(std::array{1.0, 1.0, 0.2}, std::array{0.0, 1.0, 0.0});
  CHECK(thickness[0] == doctest::Approx(2));
}

TEST_CASE("a point in front of a saddle vertex has no radius") {
  // A fan around the vertex 6, closed by the vertex 7. Of the faces at the vertex 6 the one whose plane is farthest
  // from these points has them behind it.
  constexpr std::array kHeights{-0.6, 0.7, -0.4, 1.0, -0.4, -0.5}, kReaches{0.5, 0.3, 0.6, 0.5, 0.5, 0.5};
  Mesh mesh;
  for (uint32_t i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi * i / 3;
    mesh.vertices.push_back({kReaches[i] * std::cos(angle), kReaches[i] * std::sin(angle), kHeights[i]});
    mesh.faces.push_back({i, (i + 1) % 6, 6});
    mesh.faces.push_back({(i + 1) % 6, i, 7});
  }
  mesh.vertices.push_back({0, 0, 0});
  mesh.vertices.push_back({0, 0, -3});
  Scene scene(referenceSession(), mesh);
  std::vector<double> points{0.008, -0.032, 0.87, 0.072, 0.092, 0.851, 0.448, 0.311, 0.817, 0.107, 0.071, 0.813};
  for (const double radius : scene.radii(points)) CHECK(std::isnan(radius));
  points = pointsAround(mesh, 3000, 7);
  const std::vector<double> radii = scene.radii(points), distances = scene.distance(points);
  for (size_t i = 0; i < radii.size(); ++i)
    if (distances[i] > 1e-9) CHECK(std::isnan(radii[i]) == (windingNumber(mesh, at(points, i)) < 0.5));
}

TEST_CASE("radii of a tube, a Y-branch and a torus at three resolutions") {
  // Points of the centre lines, away from ends and forks, where the radius of the smooth shape is that of the tube.
  struct Shape {
    const char* name;
    std::function<Mesh(uint64_t)> make;
    double radius;
    std::vector<double> points;
  };
  std::vector<Shape> kinds{
      {"tube", [](uint64_t count) { return makeCylinder(count, 0.25, 5).mesh; }, 0.25, {}},
      {"Y-branch",
       [](uint64_t count) {
         std::vector<Capsule> branches;
         for (const double angle : {0.0, 2.2, -2.2})
           branches.push_back({{0, 0, 0}, {0, 2 * std::sin(angle), 2 * std::cos(angle)}, 0.3, 0.3, 0, 0});
         return polygonise(CapsuleUnion(branches), count).mesh;
       },
       0.3,
       {}},
      {"torus", [](uint64_t count) { return makeTorus(count, 1, 0.3).mesh; }, 0.3, {}}};
  for (int i = 0; i < 60; ++i) {
    const double share = i / 60.0, along = 0.7 + 1.3 * share, angle = i % 3 == 0 ? 0 : i % 3 == 1 ? 2.2 : -2.2;
    kinds[0].points.insert(kinds[0].points.end(), {0, 0, 4 * share - 2});
    kinds[1].points.insert(kinds[1].points.end(), {0, along * std::sin(angle), along * std::cos(angle)});
    const double turn = 2 * std::numbers::pi * share;
    kinds[2].points.insert(kinds[2].points.end(), {std::cos(turn), std::sin(turn), 0});
  }
  for (const Shape& shape : kinds) {
    double before = kNone;
    for (const uint64_t faceCount : {600, 4000, 30000}) {
      CAPTURE(shape.name);
      CAPTURE(faceCount);
      const Mesh mesh = shape.make(faceCount);
      Scene scene(referenceSession(), mesh);
      const std::vector<double> radii = scene.radii(shape.points);
      double greatest = 0;
      for (size_t i = 0; i < radii.size(); ++i) {
        REQUIRE(!std::isnan(radii[i]));
        if (i % 4 == 0) CHECK(std::abs(radii[i] - bruteDistance(mesh, at(shape.points, i))) <= 1e-6 * shape.radius);
        greatest = std::max(greatest, std::abs(radii[i] / shape.radius - 1));
      }
      CHECK(greatest < before);
      before = greatest;
    }
    CHECK(before < 0.01);
  }
}

TEST_CASE("distances and radii from far away") {
  const Mesh mesh = shapes::cube();  // From -1 to 1.
  Scene scene(referenceSession(), mesh);
  for (const double x : {1e3, 1e9, 1e99, 1e103, 1e200, 1e308}) {
    CAPTURE(x);
    CHECK(scene.distance(std::array{x, 0.3, 0.2}).front() == doctest::Approx(x - 1).epsilon(1e-12));
    CHECK(scene.distance(std::array{-x, x, x}).front() ==
          doctest::Approx(std::min(std::sqrt(3.0) * x, 1.7e308)).epsilon(0.06));
    CHECK(std::isnan(scene.radii(std::array{x, 0.3, 0.2}).front()));
    CHECK(std::isnan(scene.radii(std::array{-x, x, x}).front()));
  }
}

TEST_CASE("distances do not depend on the number of threads") {
  const Mesh mesh = makeHand(3000).mesh;
  Scene scene(referenceSession(), mesh);
  const std::vector<double> points = pointsAround(mesh, 3000, 2);
  const std::vector<double> distances = scene.distance(points), radii = scene.radii(points);
  const Scene::RayHits hits = scene.firstHits(points, points);
  const ThreadLimit one(1);
  CHECK(test::haveSameBits(scene.distance(points), distances));
  CHECK(test::haveSameBits(scene.radii(points), radii));
  CHECK(test::haveSameBits(scene.firstHits(points, points).distances, hits.distances));
}

TEST_CASE("rays hit the first face on either side, from anywhere") {
  const Mesh mesh = shapes::cube();
  Scene scene(referenceSession(), mesh);
  struct Ray {
    Vec3d origin, direction;
    double distance;
  };
  for (const auto& [origin, direction, expected] :
       {Ray{{0.2, 0.1, 0}, {5, 0, 0}, 0.8}, Ray{{-3, 0.1, 0.3}, {1e-200, 0, 0}, 2},
        Ray{{-3, 0.1, 0.3}, {-1, 0, 0}, kNone}, Ray{{-1e6, 0.1, 0.3}, {1, 0, 0}, 1e6 - 1},
        Ray{{4, 4, 0.3}, {-1, -1, 0}, std::sqrt(18.0)}, Ray{{1e200, 0, 0}, {-1, 0, 0}, kNone},
        Ray{{2, 2, 2}, {0, 1, 0}, kNone}}) {
    const double distance = expected;
    const Scene::RayHits hits =
        scene.firstHits(std::array{origin.x, origin.y, origin.z}, std::array{direction.x, direction.y, direction.z});
    if (std::isinf(distance)) {
      CHECK(std::isinf(hits.distances[0]));
      CHECK(hits.faces[0] == kNoSegment);
      continue;
    }
    CHECK(hits.distances[0] == doctest::Approx(distance).epsilon(1e-9));
    REQUIRE(hits.faces[0] < mesh.faces.size());
    const auto& [a, b, c] = mesh.faces[hits.faces[0]];
    const Vec3d place = origin + hits.distances[0] / length(1e150 * direction) * (1e150 * direction);
    CHECK(triangleDistance(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], place) < 1e-6);
  }
}

TEST_CASE("points that are not finite, and a mesh without a surface, are errors") {
  const Mesh mesh = shapes::cube(), line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}};
  Scene scene(referenceSession(), mesh), none(referenceSession(), line);
  const std::vector<double> good(9, 0.5);
  for (const double bad : {std::nan(""), kNone}) {
    std::vector<double> wrong = good;
    wrong[4] = bad;
    requireFailure([&] { (void)scene.distance(wrong); }, ErrorCode::NonFiniteNumber, "point 1 has");
    requireFailure([&] { (void)scene.radii(wrong); }, ErrorCode::NonFiniteNumber, "point 1 has");
    requireFailure([&] { (void)scene.firstHits(good, wrong); }, ErrorCode::NonFiniteNumber, "point 1 has");
  }
  requireFailure([&] { (void)scene.distance(std::span(good).first(4)); }, ErrorCode::ArraySize);
  requireFailure([&] { (void)scene.firstHits(good, std::vector<double>(9)); }, ErrorCode::OptionOutOfRange);
  requireFailure([&] { (void)none.distance(good); }, ErrorCode::NoValues);
  requireFailure([&] { (void)none.radii(good); }, ErrorCode::NoValues);
  CHECK(none.distance({}).empty());
  CHECK(none.firstHits(good, good).faces == std::vector<uint32_t>(3, kNoSegment));
  std::stop_source stop;
  stop.request_stop();
  requireFailure([&] { (void)scene.radii(good, {stop.get_token(), {}}); }, ErrorCode::Cancelled);
  requireFailure([&] { (void)scene.firstHits(good, good, {stop.get_token(), {}}); }, ErrorCode::Cancelled);
}
