#include "trace/face_balls.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stop_token>
#include <string>
#include <vector>

#include "core/random.h"
#include "generate/shapes.h"
#include "support/bits.h"
#include "support/brute_force_thickness.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/stopped_control.h"
#include "traced_mesh.h"

using namespace asdfvk;

namespace {

/// The thickness of all faces, without greatest sections; NaN for degenerate faces and without a wall.
struct Thickness {
  std::vector<double> values, least;
};

std::vector<FaceBalls> ballsOf(const std::vector<uint32_t>& faces) {
  std::vector<FaceBalls> balls;
  for (const uint32_t face : faces) balls.push_back({face, {}, {}});
  return balls;
}

Thickness measure(const TracedMesh& traced, double wallAngle = 120) {
  const WallTree tree(traced.scene(), makeOpposingWalls({wallAngle}));
  std::vector<FaceBalls> balls = ballsOf(traced.seedFaces());
  shrinkFaceBalls(tree, balls, {});
  const std::vector<double> none(traced.mesh.faceCount(), kNoValue);
  Thickness thickness{none, none};
  const auto toLength = [&](const InscribedBall& ball) {
    return ball.wall == kNoFace ? kNoValue : traced.scene().bvh.normalization.toMeshLength(ball.ball.diameter);
  };
  for (const FaceBalls& each : balls) {
    thickness.values[each.face] = toLength(each.atBarycentre);
    thickness.least[each.face] = toLength(each.least);
  }
  return thickness;
}

static_assert(sizeof(TouchingBall) == 7 * sizeof(double));

bool isSameBall(const InscribedBall& a, const InscribedBall& b) {
  return a.wall == b.wall && test::haveSameBits(std::array{a.ball}, std::array{b.ball});
}

bool areSameBalls(const FaceBalls& a, const FaceBalls& b) {
  return a.face == b.face && isSameBall(a.atBarycentre, b.atBarycentre) && isSameBall(a.least, b.least);
}

/// Symmetric meshes, and copies of faces, are walls of equal diameters.
std::vector<TracedMesh> variousTracedMeshes() {
  std::vector<TracedMesh> meshes;
  for (const Mesh& mesh : {generateShape("animal", 4000).mesh, shapes::box({2, 1, 3}, 9), shapes::icosphere(3),
                           shapes::joined(shapes::icosphere(2), shapes::icosphere(2)), shapes::soup(300, 3)})
    meshes.emplace_back(mesh);
  return meshes;
}

/// A disc whose caps are fans of long faces around a corner of the rim. Some of their corners are nearly in line.
Mesh fannedDisc(uint32_t sideCount, double height) {
  Mesh mesh;
  for (const double z : {0.0, height})
    for (uint32_t i = 0; i < sideCount; ++i) {
      const double angle = 2 * std::numbers::pi * i / sideCount;
      mesh.vertices.push_back({std::cos(angle), std::sin(angle), z});
    }
  for (uint32_t i = 0; i < sideCount; ++i) {
    const uint32_t next = (i + 1) % sideCount;
    mesh.faces.push_back({i, next, sideCount + next});
    mesh.faces.push_back({i, sideCount + next, sideCount + i});
    if (i == 0 || next == 0) continue;
    mesh.faces.push_back({0, next, i});
    mesh.faces.push_back({sideCount, sideCount + i, sideCount + next});
  }
  return mesh;
}

void checkThicknessByBruteForce(const std::string& name, const Mesh& mesh, double wallAngle = 120) {
  CAPTURE(name);
  const TracedMesh traced(mesh);
  const Thickness found = measure(traced, wallAngle);
  const test::BruteForceThickness twin(mesh, makeOpposingWalls({wallAngle}).cosine,
                                       traced.bvh.normalization.contactLength());
  const uint32_t step = std::max(1u, mesh.faceCount() / 150);
  const double tolerance = 1e-6 * traced.geometry.bounds.diagonal();
  int differentCount = 0, valueCount = 0;
  const auto agrees = [&](double expected, double value) {
    return std::isinf(expected) ? std::isnan(value) : std::abs(expected - value) <= tolerance;
  };
  for (uint32_t face = 0; face < mesh.faceCount(); face += step) {
    if (traced.geometry.isDegenerate(face)) continue;
    differentCount += agrees(twin.at(face), found.values[face]) ? 0 : 1;
    differentCount += agrees(twin.least(face), found.least[face]) ? 0 : 1;
    valueCount += std::isnan(found.least[face]) ? 0 : 1;
  }
  CHECK(differentCount == 0);
  CHECK(valueCount > 20);
}

Mesh shapeNamed(const char* name, uint64_t faceCount) { return generateShape(name, faceCount).mesh; }

std::vector<Mesh> variousMeshes() {
  return {shapeNamed("animal", 1500),
          shapeNamed("torus", 1200),
          shapes::jittered(shapes::box({1, 2, 3}, 6), 0.02, 2),
          shapes::jittered(shapes::openBox({1, 1, 1}, 6), 0.02, 3),
          shapes::soup(300, 3),
          shapes::shell(1, 0.7)};
}

}  // namespace

TEST_CASE("the thickness is that of brute force" * doctest::test_suite("slow")) {
  int index = 0;
  for (const Mesh& mesh : variousMeshes()) checkThicknessByBruteForce(std::to_string(index++), mesh);
  checkThicknessByBruteForce("dented sphere", shapes::jittered(shapes::icosphere(3), 0.05, 1));
  checkThicknessByBruteForce("cylinder", shapes::cylinder(1, 5, 25, 8));
  for (const double height : {0.02, 0.3, 3.0})
    checkThicknessByBruteForce("disc of long faces, height " + std::to_string(height), fannedDisc(150, height));
  checkThicknessByBruteForce("hand, 150 degrees", shapeNamed("hand", 1500), 150);
  checkThicknessByBruteForce("hand, 91 degrees", shapeNamed("hand", 1500), 91);
}

TEST_CASE("a slab and a cube have the distance of their walls, edges at a right angle are not thin") {
  for (const Vec3d& size : {Vec3d{4, 4, 1}, Vec3d{2, 2, 2}, Vec3d{3, 1, 0.01}}) {
    const TracedMesh box(shapes::box(size, 7));
    const std::vector<double> values = measure(box).values;
    for (uint32_t face = 0; face < box.mesh.faceCount(); ++face) {
      const Vec3d& n = box.geometry.normals[face];
      const double expected = std::abs(n.x) > 0.5 ? size.x : std::abs(n.y) > 0.5 ? size.y : size.z;
      CHECK(values[face] == doctest::Approx(expected).epsilon(1e-12));
    }
  }
}

TEST_CASE("spheres, cylinders and tori approach their diameters as the mesh becomes finer" *
          doctest::test_suite("slow")) {
  const auto worstOf = [](const Mesh& mesh, double diameter, double greatestHeight) {
    const TracedMesh traced(mesh);
    const std::vector<double> values = measure(traced).values;
    double worst = 0;
    for (uint32_t face = 0; face < mesh.faceCount(); ++face)
      if (std::abs(traced.geometry.barycentres[face].z) < greatestHeight)
        worst = std::max(worst, std::abs(values[face] / diameter - 1));
    return worst;
  };
  CHECK(worstOf(shapes::icosphere(2, 3), 6, 10) < 0.06);
  CHECK(worstOf(shapes::icosphere(4, 3), 6, 10) < 0.06 / 10);
  // First order: barycentres are not in the middle of their sides, and a ball touches walls at 120 degrees.
  CHECK(worstOf(shapes::cylinder(0.5, 10, 16, 41), 1, 1) < 0.06);
  CHECK(worstOf(shapes::cylinder(0.5, 10, 64, 41), 1, 1) < 0.06 / 3.9);
  CHECK(worstOf(makeTorus(500).mesh, 0.6, 10) < 0.2);
  CHECK(worstOf(makeTorus(4000).mesh, 0.6, 10) < 0.2 / 2.5);
}

TEST_CASE("a wedge is as thin as the ball between its walls, from the angle of the walls on") {
  // Two wide walls at 40 degrees to each other that meet at x = 0: their normals differ by 140 degrees.
  const double half = 20 * std::acos(-1.0) / 180, w = 100;
  Mesh mesh{{{0, -w, 0},
             {0, w, 0},
             {w, -w, w * std::tan(half)},
             {w, w, w * std::tan(half)},
             {w, -w, -w * std::tan(half)},
             {w, w, -w * std::tan(half)}},
            {{0, 2, 3}, {0, 3, 1}, {0, 5, 4}, {0, 1, 5}},
            {}};
  const TracedMesh wedge(mesh);
  const std::vector<double> values = measure(wedge).values;
  for (uint32_t face = 0; face < 4; ++face) {
    // Along a wall, at the distance d from the edge, the ball has the radius d tan(20 degrees).
    const Vec3d& c = wedge.geometry.barycentres[face];
    CHECK(values[face] == doctest::Approx(2 * std::hypot(c.x, c.z) * std::tan(half)).epsilon(1e-9));
  }
  for (const double value : measure(wedge, 150).values) CHECK(std::isnan(value));
}

TEST_CASE("the rim of a plate is as thick as the plate is wide, which no ray of a cone would find") {
  const TracedMesh plate(shapes::box({10, 10, 0.1}, 1));
  const Thickness thickness = measure(plate);
  for (uint32_t face = 0; face < plate.mesh.faceCount(); ++face)
    CHECK(thickness.values[face] == doctest::Approx(std::abs(plate.geometry.normals[face].z) > 0.5 ? 0.1 : 10));
}

TEST_CASE("meshes of one face, two faces, needles, copies and none have a thickness or none, without failure") {
  const Mesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  CHECK(std::isnan(measure(TracedMesh(one)).values[0]));
  // The same face twice, in both windings: the copies are one face.
  const TracedMesh twice(Mesh{one.vertices, {{0, 1, 2}, {0, 2, 1}, {0, 1, 2}}, {}});
  for (const double value : measure(twice).values) CHECK(std::isnan(value));
  // Two faces that face away from each other, 0.25 apart.
  const TracedMesh two(shapes::joined(shapes::scaledAndShifted(one, 1, {0, 0, 0.25}), shapes::inverted(one)));
  for (const double value : measure(two).values) CHECK(value == doctest::Approx(0.25));
  Mesh needles = shapes::soup(200, 9);
  for (Vec3d& v : needles.vertices) v.x *= 1e-7;
  for (const double value : measure(TracedMesh(needles)).values) CHECK((std::isnan(value) || value >= 0));
  Mesh doubled = shapes::joined(shapes::icosphere(2), shapes::icosphere(2));
  for (size_t i = doubled.faces.size() / 2; i < doubled.faces.size(); ++i)
    doubled.faces[i] = doubled.faces[i - doubled.faces.size() / 2];
  const std::vector<double> values = measure(TracedMesh(doubled)).values;
  const std::vector<double> single = measure(TracedMesh(shapes::icosphere(2))).values;
  for (size_t i = 0; i < values.size(); ++i) CHECK(values[i] == single[i % single.size()]);
}

TEST_CASE("scaling by a power of two changes no bit, shifts and other scales only the last digits") {
  const Mesh mesh = shapes::jittered(shapes::icosphere(2), 0.05, 5);
  const std::vector<double> values = measure(TracedMesh(mesh)).values;
  std::vector<double> scaled = measure(TracedMesh(shapes::scaledAndShifted(mesh, 0x1p-10, {}))).values;
  for (double& value : scaled) value *= 0x1p10;
  CHECK(test::haveSameBits(values, scaled));
  for (const double scale : {1e-3, 1e3}) {
    const std::vector<double> moved =
        measure(TracedMesh(shapes::scaledAndShifted(mesh, scale, {10 * scale, 0, -3 * scale}))).values;
    for (size_t i = 0; i < values.size(); ++i) CHECK(moved[i] / scale == doctest::Approx(values[i]).epsilon(1e-9));
  }
}

TEST_CASE("any number of threads gives the same bits") {
  for (const TracedMesh& traced : variousTracedMeshes()) {
    const WallTree tree(traced.scene(), makeOpposingWalls({120}));
    std::vector<FaceBalls> expected = ballsOf(traced.seedFaces());
    shrinkFaceBalls(tree, expected, {});
    for (const size_t threads : {1u, 2u, 5u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const WallTree own(traced.scene(), makeOpposingWalls({120}));
      std::vector<FaceBalls> balls = ballsOf(traced.seedFaces());
      shrinkFaceBalls(own, balls, {});
      CHECK(std::equal(balls.begin(), balls.end(), expected.begin(), expected.end(), areSameBalls));
    }
  }
}

TEST_CASE("any order of any of the faces gives the same bits") {
  Random random(5);
  for (const TracedMesh& traced : variousTracedMeshes()) {
    const WallTree tree(traced.scene(), makeOpposingWalls({120}));
    std::vector<uint32_t> faces = traced.seedFaces();
    std::vector<FaceBalls> expected(traced.mesh.faceCount());
    std::vector<FaceBalls> all = ballsOf(faces);
    shrinkFaceBalls(tree, all, {});
    for (const FaceBalls& balls : all) expected[balls.face] = balls;
    for (const size_t share : {1, 3, 50}) {  // Other faces are neighbours.
      CAPTURE(share);
      random.shuffle(std::span(faces));
      std::vector<FaceBalls> balls =
          ballsOf({faces.begin(), faces.begin() + static_cast<ptrdiff_t>(faces.size() / share)});
      shrinkFaceBalls(tree, balls, {});
      CHECK(std::all_of(balls.begin(), balls.end(),
                        [&](const FaceBalls& each) { return areSameBalls(each, expected[each.face]); }));
    }
  }
}

TEST_CASE("each width of the lanes, and queries in any order, give the same bits") {
  Random random(7);
  for (const TracedMesh& traced : variousTracedMeshes()) {
    const WallTree tree(traced.scene(), makeOpposingWalls({120}));
    std::vector<uint32_t> order = traced.seedFaces();
    std::vector<BallQuery> expected(traced.mesh.faceCount());
    for (const bool isShuffled : {false, true}) {
      CAPTURE(isShuffled);
      if (isShuffled) random.shuffle(std::span(order));
      for (const InstructionSet instructionSet :
           {InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512}) {
        CAPTURE(static_cast<int>(instructionSet));
        if (!hasInstructionSet(instructionSet)) {
          MESSAGE("not on this machine: instruction set " << static_cast<int>(instructionSet));
          continue;
        }
        std::vector<BallQuery> queries;
        for (const uint32_t face : order)
          queries.push_back({triangleOf(traced.scene(), face), traced.scene().originOf(face), {}, {}});
        tree.shrink(queries, instructionSet);
        const bool isFirst = !isShuffled && instructionSet == InstructionSet::Baseline;
        size_t differentCount = 0;
        for (size_t i = 0; i < order.size(); ++i) {
          BallQuery& known = expected[order[i]];
          if (isFirst) known = queries[i];
          const bool isSame =
              isSameBall(queries[i].atPoint, known.atPoint) && isSameBall(queries[i].least, known.least);
          differentCount += isSame ? 0 : 1;
        }
        CHECK(differentCount == 0);
      }
    }
  }
}

TEST_CASE("a bound above a diameter changes no bit of the ball, and below it there is no wall") {
  for (const TracedMesh& traced : variousTracedMeshes()) {
    const WallTree tree(traced.scene(), makeOpposingWalls({120}));
    std::vector<FaceBalls> expected = ballsOf(traced.seedFaces());
    shrinkFaceBalls(tree, expected, {});
    for (const double factor : {1.5, 1 + 1e-6, 1 - 1e-6}) {
      CAPTURE(factor);
      std::vector<FaceBalls> balls = ballsOf(traced.seedFaces());
      for (size_t i = 0; i < balls.size(); ++i) {
        balls[i].atBarycentre.ball.diameter = factor * expected[i].atBarycentre.ball.diameter;
        balls[i].least.ball.diameter = factor * expected[i].least.ball.diameter;
      }
      shrinkFaceBalls(tree, balls, {});
      size_t wrongCount = 0;
      for (size_t i = 0; i < balls.size(); ++i) {
        const auto isRight = [&](const InscribedBall& ball, const InscribedBall& known) {
          return factor > 1 ? known.wall == kNoFace || isSameBall(ball, known) : ball.wall == kNoFace;
        };
        wrongCount += isRight(balls[i].atBarycentre, expected[i].atBarycentre) ? 0 : 1;
        wrongCount += isRight(balls[i].least, expected[i].least) ? 0 : 1;
      }
      CHECK(wrongCount == 0);
    }
  }
}

TEST_CASE("progress increases from 0 to 1, and a stop request ends the work between chunks") {
  const TracedMesh traced(shapeNamed("torus", 20'000));
  const WallTree tree(traced.scene(), makeOpposingWalls({120}));
  std::vector<FaceBalls> balls = ballsOf(traced.seedFaces());
  std::vector<double> fractions;
  std::stop_source stop;
  shrinkFaceBalls(tree, balls, {stop.get_token(), [&](double fraction) { fractions.push_back(fraction); }});
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  REQUIRE(fractions.size() > 2);
  CHECK(fractions.front() == 0);
  CHECK(fractions.back() == 1);
  uint32_t checkpointCount = 0;
  const RunControl stopping{stop.get_token(), [&](double fraction) {
                              ++checkpointCount;
                              if (fraction > 0) stop.request_stop();
                            }};
  test::requireFailure([&] { shrinkFaceBalls(tree, balls, stopping); }, ErrorCode::Cancelled);
  CHECK(checkpointCount == 2);
}

TEST_CASE("a stop request ends the construction of the tree of walls") {
  const TracedMesh traced(generateShape("sphere", 80).mesh);
  test::requireFailure(
      [&] { (void)WallTree(traced.scene(), makeOpposingWalls({120}), nullptr, test::stoppedControl()); },
      ErrorCode::Cancelled);
}
