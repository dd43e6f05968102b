#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "generate/thickness_parts.h"
#include "mesh/face_geometry.h"
#include "random_solids/random_boxes.h"
#include "support/shared_session.h"

// Parts of known least thickness (generate/thickness_parts.h) through the whole library.

using namespace asdfvk;
using namespace std::string_view_literals;

namespace {

Session& partSession() { return *test::allSessions().back(); }

Options limitedTo(double limit, bool countsEdges = false) {
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = limit;
  options.thickness.countsEdges = countsEdges;
  options.thickness.findsNextWall = true;
  return options;
}

ThicknessReport measure(const Mesh& mesh, const Options& options, Session& session = partSession()) {
  return session.compute(mesh, options).report.thickness.value();
}

/// Least value of a field over all faces.
double leastOf(const Mesh& mesh, const char* field) {
  const Result result = partSession().compute(mesh, limitedTo(1));
  const std::vector<double>& values = *result.field(field)->reals();
  return *std::min_element(values.begin(), values.end(), [](double a, double b) { return a < b || std::isnan(b); });
}

/// By yaw, then by pitch, then scaled.
Mesh placed(Mesh mesh, double yaw, double pitch, double unit) {
  for (Vec3d& v : mesh.vertices) {
    const double x = v.x * std::cos(yaw) - v.y * std::sin(yaw), y = v.x * std::sin(yaw) + v.y * std::cos(yaw);
    v = unit * Vec3d{x, y * std::cos(pitch) - v.z * std::sin(pitch), y * std::sin(pitch) + v.z * std::cos(pitch)};
  }
  return mesh;
}

/// A part in a triangulation, a rotation and a unit.
struct PartSample {
  Mesh mesh;
  double unit = 1;
};

/// The coarsest triangulation and two others; each one in two rotations and in two units.
std::vector<PartSample> samplesOf(const BlockSolid& solid) {
  constexpr std::array<std::array<double, 2>, 3> kRotations{{{0, 0}, {0.5, 1.1}, {2.3, -0.4}}};  // Yaw, pitch.
  const double size = boundsOfFiniteVertices(solid.surface()).diagonal();
  std::vector<PartSample> samples;
  for (uint64_t i = 0; i < 6; ++i) {
    const double longestEdge = std::array{10 * size, size / 8, size / 20}[i % 3], unit = i < 3 ? 1 : 0.001;
    const auto [yaw, pitch] = kRotations[(i % 3 + i / 3) % 3];
    samples.push_back({placed(solid.surface({.longestEdge = longestEdge, .diagonalSeed = i}), yaw, pitch, unit), unit});
  }
  return samples;
}

/// The largest ball is found to a relative 1e-3, and it bounds the thickness of a cube.
double toleranceOf(std::string_view part) { return part == "thick-cube" ? 1e-3 : 1e-6; }

/// Random triangulation and rotation.
Mesh randomlyTriangulated(const ThicknessPart& part, uint64_t seed) {
  const double longestEdge = std::array{1e9, 8.0, 3.0}[seed % 3];
  return placed(part.solid.surface({.longestEdge = longestEdge, .diagonalSeed = seed}), 0.1 * static_cast<double>(seed),
                0.7 * static_cast<double>(seed), 1);
}

}  // namespace

/// A limit at which the least wall of a part is a wall, divided by the thickness of this wall. Walls that taper count
/// from a greater limit on, and ligaments up to 0.93 of the limit.
constexpr double kSurelyThin = 1.1;

TEST_CASE("each part has its least thickness, whatever the triangulation, the rotation and the unit" *
          doctest::test_suite("slow")) {
  for (const std::string_view name : thicknessPartNames()) {
    CAPTURE(name);
    const ThicknessPart part = makeThicknessPart(name);
    if (part.leastThickness == 0) continue;
    const bool hasEdge = name == "flat-thread";  // The teeth taper by 19 degrees.
    for (const PartSample& sample : samplesOf(part.solid)) {
      const double least = sample.unit * part.leastThickness;
      CAPTURE(sample.mesh.faces.size());
      CAPTURE(sample.unit);
      const Result result = partSession().compute(sample.mesh, limitedTo(0.99 * least));
      const ThicknessReport& passed = result.report.thickness.value();
      const std::vector<double>& values = *result.field("least_thickness")->reals();
      CHECK(*std::min_element(values.begin(), values.end()) == doctest::Approx(least).epsilon(toleranceOf(name)));
      CHECK(passed.verdict == ThicknessVerdict::Passed);
      CHECK(passed.regions.empty());
      // The next wall, to 5 %.
      CHECK_FALSE(passed.min < least * (1 - toleranceOf(name)));
      if (!hasEdge) CHECK(passed.min <= 1.05 * kSurelyThin * least);
      const ThicknessReport counted = measure(sample.mesh, limitedTo(1.01 * least, true));
      CHECK(counted.verdict == ThicknessVerdict::Failed);
      CHECK(counted.min < 1.01 * least);
    }
    const double limit = part.leastThickness * kSurelyThin;
    const ThicknessReport failed = measure(part.solid.surface(), limitedTo(limit));
    REQUIRE_FALSE(failed.regions.empty());
    CHECK(failed.verdict == (hasEdge ? ThicknessVerdict::Passed : ThicknessVerdict::Failed));
    CHECK(failed.regions[0].kind == (hasEdge ? ThinKind::Edge : ThinKind::Wall));
    CHECK(failed.regions[0].least == doctest::Approx(part.leastThickness).epsilon(toleranceOf(name)));
    if (hasEdge) continue;
    CHECK(failed.regions[0].min == failed.min);
    CHECK(failed.min < limit);
    CHECK(length(*failed.minPlace - *failed.minOpposite) <= failed.min * (1 + toleranceOf(name)));
  }
}

TEST_CASE("the thickness at sharp edges and tips is 0; narrow ones are walls, others are edges, at each triangulation" *
          doctest::test_suite("slow")) {
  for (const std::string_view name : {"knife"sv, "blade"sv, "spike"sv, "sharp-thread"sv}) {
    CAPTURE(name);
    const ThicknessPart part = makeThicknessPart(name);
    const double limit = std::min(1.0, 0.99 * part.leastWall);
    const bool isWall = part.sharpAngleDegrees < 17;
    for (const PartSample& sample : samplesOf(part.solid)) {
      const double unit = sample.unit;
      CAPTURE(sample.mesh.faces.size());
      const ThicknessReport report = measure(sample.mesh, limitedTo(unit * limit));
      CHECK(report.verdict == (isWall ? ThicknessVerdict::Failed : ThicknessVerdict::Passed));
      CHECK(report.regions.size() == (name == "sharp-thread" ? 2 : 1));
      for (const ThinRegion& region : report.regions) {
        CHECK(region.kind == (isWall ? ThinKind::Wall : ThinKind::Edge));
        CHECK(region.least == 0);
        CHECK((region.min > 0) == isWall);
        if (name != "spike") CHECK(region.angleDegrees == doctest::Approx(part.sharpAngleDegrees).epsilon(1e-3));
      }
      if (isWall) CHECK(report.min < unit * limit);
      if (!isWall) CHECK_FALSE(report.min < unit * limit);
      const ThicknessReport counted = measure(sample.mesh, limitedTo(unit * limit, true));
      CHECK(counted.verdict == ThicknessVerdict::Failed);
      CHECK(counted.regions.size() == report.regions.size());
      if (!isWall) CHECK(counted.min == 0);
    }
  }
}

TEST_CASE("a search for the next wall that ends early finds the same wall or none") {
  size_t foundCount = 0;
  for (const std::string_view name : thicknessPartNames()) {
    CAPTURE(name);
    const Mesh mesh = makeThicknessPart(name).solid.surface();
    for (const double limit : {0.05, 0.5}) {
      Options options = limitedTo(limit);
      const ThicknessReport whole = measure(mesh, options);
      options.thickness.findsNextWall = false;
      const ThicknessReport quick = measure(mesh, options);
      CHECK(quick.verdict == whole.verdict);
      if (std::isnan(quick.min)) continue;
      ++foundCount;
      CHECK(quick.min == whole.min);
      CHECK(quick.minFace == whole.minFace);
    }
  }
  CHECK(foundCount > thicknessPartNames().size());
}

TEST_CASE("a pocket of a part with a thin edge is a wall of its own") {
  const ThicknessPart part = makeThicknessPart("blade");
  for (const PartSample& sample : samplesOf(part.solid)) {
    const ThicknessReport report = measure(sample.mesh, limitedTo(1.01 * sample.unit * part.leastWall));
    CHECK(report.verdict == ThicknessVerdict::Failed);
    REQUIRE(report.regions.size() == 2);
    CHECK(report.regions[1].min == doctest::Approx(sample.unit * part.leastWall).epsilon(1e-6));
    CHECK(report.regions[1].kind == ThinKind::Wall);
  }
}

TEST_CASE("barycentres alone miss the least thickness of a coarse wedge and ligament") {
  for (const std::string_view name : {"wedge"sv, "thin-wedge"sv, "ligament-24"sv}) {
    CAPTURE(name);
    const ThicknessPart part = makeThicknessPart(name);
    const Mesh mesh = part.solid.surface();
    CHECK(leastOf(mesh, "least_thickness") == doctest::Approx(part.leastThickness).epsilon(1e-6));
    CHECK(leastOf(mesh, "thickness") > 1.01 * part.leastThickness);
  }
}

TEST_CASE("percentiles of parts with a thickness that most of them have") {
  const auto percentiles = [](const char* name) {
    return measure(makeThicknessPart(name).solid.surface({.longestEdge = 2}), limitedTo(0.1));
  };
  const ThicknessReport box = percentiles("shelled-box"), cube = percentiles("thick-cube"),
                        plate = percentiles("ribbed-plate");
  CHECK(box.median == doctest::Approx(2).epsilon(0.025));
  CHECK(box.percentile5 == doctest::Approx(2).epsilon(0.07));
  CHECK(cube.median == doctest::Approx(60).epsilon(0.0016));
  CHECK(cube.percentile5 == doctest::Approx(60).epsilon(0.0016));
  CHECK(plate.median == doctest::Approx(2.5).epsilon(0.04));
  CHECK(leastOf(makeThicknessPart("ribbed-plate").solid.surface({.longestEdge = 2}), "least_thickness") ==
        doctest::Approx(1.5).epsilon(0.03));
}

TEST_CASE("no alarm for 100 sound boxes, and one for each of 100 with a thin place" * doctest::test_suite("slow")) {
  constexpr double kLimit = 0.8;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    const ThicknessPart sound = makeSoundBox(seed, kLimit), thin = makeBoxWithThinPlace(seed, kLimit);
    const ThicknessReport passed = measure(randomlyTriangulated(sound, seed), limitedTo(kLimit));
    CHECK(passed.verdict == ThicknessVerdict::Passed);
    CHECK_FALSE(passed.min < sound.leastThickness * (1 - 1e-6));
    CHECK(passed.regions.empty());
    const ThicknessReport failed = measure(randomlyTriangulated(thin, seed), limitedTo(kLimit));
    CHECK(failed.verdict == ThicknessVerdict::Failed);
    CHECK(failed.min == doctest::Approx(thin.leastThickness).epsilon(1e-3));  // The least wall is found to 0.1 %.
    CHECK_FALSE(failed.regions.empty());
  }
}

TEST_CASE("a device finds the least thickness of each part" * doctest::test_suite("slow")) {
  for (const std::string_view name : thicknessPartNames()) {
    CAPTURE(name);
    const ThicknessPart part = makeThicknessPart(name);
    const double limit = std::max(0.1, kSurelyThin * part.leastThickness);
    const ThicknessReport report =
        measure(part.solid.surface({.longestEdge = 12}), limitedTo(limit, true), test::vulkanSession());
    REQUIRE_FALSE(report.regions.empty());
    double least = limit;
    for (const ThinRegion& region : report.regions) least = std::min(least, region.least);
    CHECK(least == doctest::Approx(part.leastThickness).epsilon(toleranceOf(name)));
  }
}

TEST_CASE("a thin plate between two others is a part of them, whatever the order of the plates") {
  constexpr std::array<std::array<double, 2>, 3> kPlates{{{0, 2}, {2, 2.3}, {2.3, 4.3}}};  // Heights; they touch.
  constexpr std::array<std::array<size_t, 3>, 3> kOrders{{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}}};
  for (const auto& order : kOrders) {
    Mesh mesh;
    for (const size_t plate : order) {
      const auto base = static_cast<uint32_t>(mesh.vertices.size());
      for (const double z : kPlates[plate])
        for (const Vec3d& v : {Vec3d{0, 0, z}, Vec3d{10, 0, z}, Vec3d{10, 10, z}, Vec3d{0, 10, z}})
          mesh.vertices.push_back(v);
      // The faces of touching plates coincide.
      for (const Face& f : {Face{0, 2, 1}, Face{0, 3, 2}, Face{4, 5, 6}, Face{4, 6, 7}, Face{0, 1, 5}, Face{0, 5, 4},
                            Face{1, 2, 6}, Face{1, 6, 5}, Face{2, 3, 7}, Face{2, 7, 6}, Face{3, 0, 4}, Face{3, 4, 7}})
        mesh.faces.push_back({base + f[0], base + f[1], base + f[2]});
    }
    CAPTURE(order[1]);
    CHECK(measure(mesh, limitedTo(0.8)).min == doctest::Approx(4.3));
  }
}
