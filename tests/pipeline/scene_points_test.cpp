#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "asdf_vk/scene.h"
#include "cone/cone.h"
#include "cone/cone_value.h"
#include "core/random.h"
#include "generate/shapes.h"
#include "mesh/face_geometry.h"
#include "support/bits.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "support/surface_points.h"

using namespace asdfvk;
using test::allSessions;
using test::barycentresOf;
using test::referenceSession;
using test::requireFailure;
using test::SurfacePoints;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> valuesAt(Scene& scene, const SurfacePoints& points, const ConeOptions& cone = {}) {
  return scene.valuesAt(points.points, points.normals, cone);
}

Vec3d unit(const Vec3d& v) { return v / length(v); }

/// The shape diameter at a point of an axis-aligned box around 0, from the distances to its sides.
double valueInBox(const Vec3d& size, const Cone& cone, const Vec3d& point, const Vec3d& normal) {
  const Vec3d origin = point - kPointOffset * length(size) * normal;
  const ConeFrame frame = cone.definition == Definition::Paper ? coneFrame(-normal) : cgalConeFrame(-normal);
  std::vector<double> lengths, weights;
  for (size_t i = 0; i < cone.directions.size(); ++i) {
    const Vec3d d = frame.toWorld(cone.directions[i]);
    double nearest = kInfinity;
    Vec3d hitNormal;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double side = d[axis] < 0 ? -0.5 * size[axis] : 0.5 * size[axis], t = (side - origin[axis]) / d[axis];
      if (d[axis] == 0 || !(t < nearest)) continue;
      nearest = t;
      hitNormal = {};
      hitNormal[axis] = d[axis] < 0 ? -1 : 1;
    }
    if (isFalseHit(cone, normal, d, hitNormal)) continue;
    lengths.push_back(nearest);
    weights.push_back(cone.weights[i]);
  }
  return coneValue(lengths, weights, cone.outliers);
}

/// The number of values of two arrays that differ by more than the tolerance. A value in only one array also counts.
size_t differingCount(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  REQUIRE(a.size() == b.size());
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i)
    count += std::isnan(a[i]) || std::isnan(b[i]) ? std::isnan(a[i]) != std::isnan(b[i])
                                                  : !(std::abs(a[i] - b[i]) <= tolerance);
  return count;
}

ConeOptions cgalCone() {
  Options options;
  applyDefinition(Definition::Cgal, options);
  return options.cone;
}

}  // namespace

TEST_CASE("points of a box have the value of the distances to its sides, with any normal") {
  const Vec3d size{2, 3, 4};
  const Mesh mesh = shapes::box(size, 3);
  Random random(1);
  const auto within = [&](double limit) { return limit * (2 * random.real() - 1); };
  SurfacePoints points;
  for (int i = 0; i < 200; ++i) {  // On the sides, with normals up to 25 degrees from theirs.
    Vec3d p{within(0.48 * size.x), within(0.48 * size.y), within(0.48 * size.z)}, n;
    const size_t axis = random.index(3);
    const double sign = i % 2 == 0 ? 1 : -1;
    p[axis] = sign * 0.5 * size[axis];
    n[axis] = sign;
    if (i % 4 > 1) n += Vec3d{within(0.25), within(0.25), within(0.25)};
    points.add(p, 5.0 * n);
  }
  for (int i = 0; i < 100; ++i)  // Inside.
    points.add({within(0.4 * size.x), within(0.4 * size.y), within(0.4 * size.z)}, {within(1), within(1), within(1)});
  for (const ConeOptions& options :
       {ConeOptions{}, cgalCone(), ConeOptions{.rayCount = 12, .openingAngleDegrees = 40}}) {
    const Cone cone = makeCone(options);
    std::vector<double> expected;
    for (size_t i = 0; i < points.size(); ++i)
      expected.push_back(valueInBox(size, cone, points.point(i), unit(points.normal(i))));
    for (Session* session : allSessions()) {
      CAPTURE(session->backend());
      Scene scene(*session, mesh);
      // Rounding may change which rays are outliers, and which hits are false.
      CHECK(differingCount(valuesAt(scene, points, options), expected, 1e-5) <=
            (session == &referenceSession() ? 0 : 3));
    }
  }
}

TEST_CASE("on a slab the value is the published one of the thickness below the offset") {
  constexpr double kUnitSlabValue = 1.2531787496312747;  // tests/trace/analytic_test.cpp.
  const Vec3d size{9, 9, 1};
  const Mesh mesh = shapes::box(size, 2);
  SurfacePoints points;
  for (const double x : {-0.5, 0.0, 0.3})
    for (const double side : {-1.0, 1.0}) points.add({x, 0.1, 0.5 * side}, {0, 0, side});
  for (Session* session : allSessions()) {
    Scene scene(*session, mesh);
    for (const double value : valuesAt(scene, points))
      CHECK(value == doctest::Approx((1 - kPointOffset * length(size)) * kUnitSlabValue).epsilon(1e-6));
  }
}

TEST_CASE("on a sphere the values of points approach the exact one") {
  constexpr ConeOptions kNarrowCone = {30, 80};
  constexpr double kUnitSphereInNarrowCone = 1.781859515259041;  // tests/trace/analytic_test.cpp.
  const Mesh mesh = shapes::icosphere(5, 3);
  SurfacePoints points;
  for (size_t f = 0; f < mesh.faces.size(); f += 97) {  // Off the barycentres; radial normals.
    const auto [a, b, c] = mesh.faces[f];
    const Vec3d p = 0.6 * mesh.vertices[a] + 0.3 * mesh.vertices[b] + 0.1 * mesh.vertices[c];
    points.add(p, p);
  }
  for (size_t v = 0; v < mesh.vertices.size(); v += 211) points.add(mesh.vertices[v], mesh.vertices[v]);
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene scene(*session, mesh);
    for (const double value : valuesAt(scene, points, kNarrowCone))
      CHECK(value / 3 == doctest::Approx(kUnitSphereInNarrowCone).epsilon(0.01));
  }
}

TEST_CASE("at barycentres with face normals the values are those of the faces") {
  for (const Mesh& mesh : {makeTorus(3000).mesh, shapes::jittered(shapes::box({1, 2, 3}, 6), 0.02, 3),
                           shapes::shell(1, 0.8), shapes::openBox({1, 1, 2}, 5)}) {
    const SurfacePoints points = barycentresOf(mesh);
    const double diagonal = computeFaceGeometry(mesh).bounds.diagonal();
    for (Session* session : allSessions()) {
      Scene scene(*session, mesh);
      for (const ConeOptions& cone : {ConeOptions{}, cgalCone()}) {
        Options options = test::allSeeds();
        options.cone = cone;
        const std::vector<double> ofFaces = session->compute(mesh, options).sdf();
        CAPTURE(session->backend());
        CAPTURE(static_cast<int>(cone.definition));
        CAPTURE(mesh.faces.size());
        // A ray that passes close to an edge may hit its other side; that changes few values.
        CHECK(differingCount(valuesAt(scene, points, cone), ofFaces, 1e-4 * diagonal) <= mesh.faces.size() / 100);
      }
    }
  }
}

TEST_CASE("values of points do not depend on the unit and the place of the mesh, nor on the length of the normals") {
  const Mesh mesh = makeTorus(800).mesh;
  const SurfacePoints points = barycentresOf(mesh);
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene scene(*session, mesh);
    const std::vector<double> values = valuesAt(scene, points);
    struct Place {
      double scale, shift, normalLength;
    };
    for (const auto& [size, shift, normalLength] :
         {Place{0x1p-100, 0, 1e-300}, Place{1e-3, 0, 1e300}, Place{1e3, 0, 1}, Place{1e30, 0, 1}, Place{1, 1e6, 1}}) {
      const double scale = size;
      CAPTURE(scale);
      const Mesh moved = shapes::scaledAndShifted(mesh, scale, {shift, -shift, shift});
      SurfacePoints movedPoints;
      for (size_t i = 0; i < points.size(); ++i)
        movedPoints.add(scale * points.point(i) + Vec3d{shift, -shift, shift}, normalLength * unit(points.normal(i)));
      Scene movedScene(*session, moved);
      std::vector<double> relative = valuesAt(movedScene, movedPoints);
      for (double& value : relative) value /= scale;
      CHECK(differingCount(relative, values, 1e-5) <= 4);
    }
  }
}

TEST_CASE("a small part of a large scene is resolved") {
  // A sphere whose diameter is 2^-13 of the box, beside one that fills it.
  const double radius = 1e-4;
  const Mesh small = shapes::scaledAndShifted(shapes::icosphere(3), radius);
  const Mesh mesh = shapes::joined(small, shapes::icosphere(3), {2, 0, 0});
  SurfacePoints points;
  for (size_t f = 0; f < small.faces.size(); f += 7) {
    const auto [a, b, c] = small.faces[f];
    const Vec3d p = (small.vertices[a] + small.vertices[b] + small.vertices[c]) / 3.0;
    points.add(p, p);
  }
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene scene(*session, mesh);
    for (const double value : valuesAt(scene, points, {30, 40}))
      CHECK(value == doctest::Approx(1.9 * radius).epsilon(0.3));  // The offset is 0.35 of the radius.
  }
}

TEST_CASE("points without a valid ray have no value") {
  const Mesh grid = shapes::grid(4), sphere = shapes::sphere(3);
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene plane(*session, grid), ball(*session, sphere);
    for (const ConeOptions& cone : {ConeOptions{}, cgalCone()}) {
      // Behind the grid; on it, looking away; far from it.
      for (const double z : {-1.0, 0.0, 1e9})
        CHECK(std::isnan(plane.valuesAt(std::array{2.1, 2.2, z}, std::array{0.0, 0.0, 1.0}, cone).front()));
      // Outside of the ball: rays hit the outer side, or nothing.
      for (const double x : {1.1, 1.3, 1e5, 1e200})
        for (const double side : {-1.0, 1.0})
          CHECK(std::isnan(ball.valuesAt(std::array{x, 0.0, 0.0}, std::array{side, 0.0, 0.0}, cone).front()));
    }
  }
}

TEST_CASE("cones far outside of the bounding box reach the mesh") {
  const Mesh mesh = shapes::inverted(shapes::icosphere(4));  // So that hits from outside are valid.
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene scene(*session, mesh);
    for (const double distance : {1.005, 1.5, 3.0, 1000.0, 1e6}) {
      const double angle = 0.1 / distance;
      const double value =
          scene.valuesAt(std::array{0.0, distance, 0.0}, std::array{0.0, 1.0, 0.0}, {16, angle}).front();
      CAPTURE(distance);
      CHECK(value == doctest::Approx(distance - 1).epsilon(0.02));
    }
  }
}

TEST_CASE("a mesh that rays cannot hit gives no value at points") {
  Mesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.faces = {{0, 1, 2}};
  for (Session* session : allSessions()) {
    Scene scene(*session, line);
    CHECK(std::isnan(scene.valuesAt(std::array{0.5, 0.0, 0.0}, std::array{0.0, 0.0, 1.0}).front()));
  }
}

TEST_CASE("a point has the same value alone, among others, and in another order") {
  const Mesh mesh = makeTorus(800).mesh;
  const SurfacePoints points = barycentresOf(mesh);
  ConeOptions hashed;
  hashed.rotation = ConeRotation::Hashed;
  for (Session* session : allSessions()) {
    CAPTURE(session->backend());
    Scene scene(*session, mesh);
    for (const ConeOptions& cone : {ConeOptions{}, hashed}) {
      const std::vector<double> together = valuesAt(scene, points, cone);
      SurfacePoints reversed;
      for (size_t i = points.size(); i-- > 0;) reversed.add(points.point(i), points.normal(i));
      std::vector<double> values = valuesAt(scene, reversed, cone);
      std::reverse(values.begin(), values.end());
      CHECK(test::haveSameBits(values, together));
      SurfacePoints one;
      one.add(points.point(5), points.normal(5));
      CHECK(valuesAt(scene, one, cone).front() == together[5]);
    }
  }
  Scene scene(referenceSession(), mesh);
  CHECK(valuesAt(scene, SurfacePoints{}).empty());
}

TEST_CASE("points between computations change no bit of them") {
  const Mesh mesh = makeTorus(1000).mesh;
  const SurfacePoints points = barycentresOf(mesh);
  for (Session* session : allSessions()) {
    Scene scene(*session, mesh);
    const std::vector<double> before = valuesAt(scene, points);
    const std::vector<double> computed = scene.compute().sdf();
    CHECK(computed == session->compute(mesh).sdf());
    CHECK(test::haveSameBits(valuesAt(scene, points), before));  // By a tracer that also writes hits.
  }
}

TEST_CASE("invalid points, normals and cones throw, and the message names the point") {
  const Mesh mesh = shapes::sphere(2);
  Scene scene(referenceSession(), mesh);
  const std::vector<double> good(9, 0.5);
  const auto callWith = [&](size_t i, double number, bool isNormal) {
    std::vector<double> points = good, normals = good;
    (isNormal ? normals : points)[i] = number;
    (void)scene.valuesAt(points, normals);
  };
  for (const double bad : {std::nan(""), kInfinity, -kInfinity})
    for (const bool isNormal : {false, true})
      requireFailure([&] { callWith(7, bad, isNormal); }, ErrorCode::NonFiniteNumber, "point 2 has");
  std::vector<double> normals = good;
  std::fill_n(normals.begin() + 3, 3, 0.0);
  try {
    (void)scene.valuesAt(good, normals);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::OptionOutOfRange);
    REQUIRE(error.details().size() == 1);
    CHECK(error.details()[0].name == "index");
    CHECK(error.details()[0].value == "1");
  }
  requireFailure([&] { (void)scene.valuesAt(good, std::span(good).first(6)); }, ErrorCode::ArraySize);
  requireFailure([&] { (void)scene.valuesAt(std::span(good).first(4), std::span(good).first(4)); },
                 ErrorCode::ArraySize);
  requireFailure([&] { (void)scene.valuesAt(good, good, {.rayCount = 0}); }, ErrorCode::OptionOutOfRange);
  std::stop_source source;
  source.request_stop();
  requireFailure([&] { (void)scene.valuesAt(good, good, {}, {source.get_token(), {}}); }, ErrorCode::Cancelled);
}
