#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "asdf_vk/error.h"
#include "core/stopwatch.h"
#include "generate/shapes.h"
#include "mesh/face_geometry.h"
#include "pipeline/asdf.h"
#include "support/shared_session.h"
#include "trace/embree/embree_tracer.h"

using namespace asdfvk;
using test::referenceSession;
using test::vulkanSession;

namespace {

Mesh scaledAndShifted(Mesh mesh, double scale, const Vec3d& shift) {
  for (Vec3d& v : mesh.vertices) v = v * scale + shift;
  return mesh;
}

Options allSeeds() {
  Options options;
  options.seeds.kind = SeedCount::Kind::All;
  return options;
}

/// Two spheres that do not touch.
Mesh twoSpheres(uint64_t faceCount, uint64_t smallFaceCount) {
  Mesh mesh = makeSphere(faceCount).mesh;
  const Mesh other = scaledAndShifted(makeSphere(smallFaceCount).mesh, 0.5, {4, 0, 0});
  const auto offset = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.faces) mesh.faces.push_back({a + offset, b + offset, c + offset});
  return mesh;
}

double largestRelativeDifference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]) / std::abs(b[i]));
  return largest;
}

}  // namespace

TEST_CASE("a tenth of the faces casts rays and every face gets a value") {
  Mesh mesh = makeSphere(2000).mesh;
  const Result result = vulkanSession().compute(mesh, {});
  CHECK(result.sdf.size() == mesh.faces.size());
  CHECK(result.report.seedCount == 200);
  CHECK(result.report.rayCount == 6000);
  CHECK(std::count(result.isSeed.begin(), result.isSeed.end(), 1) == 200);
  CHECK(result.report.noValueCount == 0);
  CHECK(result.report.backend == "vulkan");
  CHECK(result.report.solver.relativeResidual <= 1e-4);
  CHECK(result.report.solver.converged);
  CHECK(result.report.componentCount == 1);
  CHECK(result.report.warnings.empty());
}

TEST_CASE("without guidance interpolated values stay within the range of the seeds") {
  Mesh mesh = makeTorus(3000).mesh;
  Options options;
  options.interpolation.guidance = Guidance::None;
  const Result result = vulkanSession().compute(mesh, options);
  double low = 1e30, high = -1e30;
  for (size_t f = 0; f < result.sdf.size(); ++f)
    if (result.isSeed[f]) low = std::min(low, result.sdf[f]), high = std::max(high, result.sdf[f]);
  CHECK(result.report.sdf.min >= low - 1e-4 * (high - low));
  CHECK(result.report.sdf.max <= high + 1e-4 * (high - low));
}

TEST_CASE("two runs give the same bits") {
  Mesh mesh = makeTorus(2000).mesh;
  for (const SolverChoice solver : {SolverChoice::Eigen, SolverChoice::Cg}) {
    Options options;
    options.solver = solver;
    CHECK(vulkanSession().compute(mesh, options).sdf == vulkanSession().compute(mesh, options).sdf);
  }
}

TEST_CASE("another random seed chooses other faces") {
  Mesh mesh = makeTorus(2000).mesh;
  Options other;
  other.randomSeed = 2;
  CHECK(vulkanSession().compute(mesh, {}).isSeed != vulkanSession().compute(mesh, other).isSeed);
}

TEST_CASE("scaling and shifting a mesh scales its values and nothing else") {
  const Mesh mesh = makeTorus(2000).mesh;
  Mesh original = mesh;
  const std::vector<double> expected = vulkanSession().compute(original, allSeeds()).sdf;
  const struct {
    double scale;
    Vec3d shift;
  } cases[] = {{1e-3, {0, 0, 0}},  {1e3, {0, 0, 0}},      {1e-170, {0, 0, 0}}, {1e160, {0, 0, 0}},
               {1e307, {0, 0, 0}}, {1, {1e6, -2e6, 3e5}}, {1e3, {1e8, 0, 0}}};
  for (const auto& [scale, shift] : cases) {
    CAPTURE(scale);
    Mesh moved = scaledAndShifted(mesh, scale, shift);
    std::vector<double> values = vulkanSession().compute(moved, allSeeds()).sdf;
    for (double& value : values) value /= scale;
    // A ray that grazes an edge may change sides with the last bit of a coordinate.
    uint64_t differing = 0;
    for (size_t f = 0; f < values.size(); ++f) differing += std::abs(values[f] - expected[f]) > 1e-4 * expected[f];
    CHECK(differing <= values.size() / 1000);
  }
}

TEST_CASE("a component without a seed gets one") {
  Mesh mesh = twoSpheres(5000, 20);
  Options options;
  options.seeds = {.kind = SeedCount::Kind::Count, .share = 0, .count = 3};
  const Result result = vulkanSession().compute(mesh, options);
  CHECK(result.report.componentCount == 2);
  CHECK(result.report.noValueCount == 0);
  for (size_t f = makeSphere(5000).mesh.faces.size(); f < mesh.faces.size(); ++f) CHECK(result.sdf[f] < 1.01);
}

TEST_CASE("a component none of whose faces has a value keeps no value and is told") {
  Mesh mesh = makeSphere(500).mesh;
  mesh.vertices.insert(mesh.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  const auto v = static_cast<uint32_t>(mesh.vertices.size());
  mesh.faces.push_back({v - 3, v - 2, v - 1});
  const Result result = vulkanSession().compute(mesh, {});
  CHECK(std::isnan(result.sdf.back()));
  CHECK(result.report.noValueCount == 1);
  REQUIRE_FALSE(result.report.warnings.empty());
  CHECK(result.report.warnings.back().find("without a value") != std::string::npos);
}

TEST_CASE("a sphere twice in the file, each with vertices of its own, has the plain sphere's values") {
  const Mesh sphere = makeSphere(500).mesh;
  const auto count = static_cast<std::ptrdiff_t>(sphere.faces.size());
  Mesh plain = sphere;
  const std::vector<double> expected = referenceSession().compute(plain, allSeeds()).sdf;
  const auto twice = [&](bool isCopyInverted) {
    Mesh mesh = sphere;
    mesh.vertices.insert(mesh.vertices.end(), sphere.vertices.begin(), sphere.vertices.end());
    const auto offset = static_cast<uint32_t>(sphere.vertices.size());
    for (auto [a, b, c] : sphere.faces) {
      if (isCopyInverted) std::swap(b, c);
      mesh.faces.push_back({a + offset, b + offset, c + offset});
    }
    return mesh;
  };
  for (const bool isCopyInverted : {false, true}) {
    CAPTURE(isCopyInverted);
    Mesh mesh = twice(isCopyInverted);
    const Result result = referenceSession().compute(mesh, allSeeds());
    CHECK(std::equal(expected.begin(), expected.end(), result.sdf.begin()));
    if (isCopyInverted) {
      CHECK(std::all_of(result.sdf.begin() + count, result.sdf.end(), [](double v) { return std::isnan(v); }));
    } else {
      CHECK(std::equal(expected.begin(), expected.end(), result.sdf.begin() + count));
    }
    CHECK(result.report.defects.duplicateFaceCount == sphere.faces.size());
  }
}

TEST_CASE("where faces have no value the likely cause is told: an open surface, an inverted component, or neither") {
  const auto warningOn = [](Mesh mesh) {
    const Result result = referenceSession().compute(mesh, allSeeds());
    REQUIRE_FALSE(result.report.warnings.empty());
    return result.report.warnings.back();
  };
  const Mesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  const std::string sentence =
      "without a value: no ray from there, nor from any face that hangs together with it, found the other side of the "
      "shape";
  CHECK(warningOn(triangle) == "1 of 1 face " + sentence +
                                   ", most likely because the surface is open, so that rays escape, or looks the other "
                                   "way (--orient flip)");
  Mesh inverted = makeSphere(20).mesh;
  for (Face& face : inverted.faces) std::swap(face[1], face[2]);
  CHECK(warningOn(inverted) == "20 of 20 faces " + sentence +
                                   ", most likely because their component is inverted (--orient auto turns it over)");
  Mesh line = triangle;
  line.vertices[2] = {2, 0, 0};
  CHECK(warningOn(line) == "1 of 1 face " + sentence);

  Mesh both = inverted;
  both.vertices.insert(both.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  both.faces.push_back({12, 13, 14});
  CHECK(warningOn(both).find("inverted (--orient auto turns it over), or the surface is open") != std::string::npos);
}

TEST_CASE("degenerate faces are interpolated and the count of faces stays") {
  Mesh mesh = makeSphere(500).mesh;
  const Face first = mesh.faces[0];
  mesh.faces.push_back({first[0], first[0], first[1]});
  mesh.faces.push_back({first[0], first[1], first[1]});
  const Result result = vulkanSession().compute(mesh, allSeeds());
  CHECK(result.sdf.size() == mesh.faces.size());
  CHECK(result.isSeed.back() == 0);
  CHECK(result.report.defects.zeroAreaFaceCount == 2);
  CHECK(result.report.seedCount == mesh.faces.size() - 2);
}

TEST_CASE("a mesh of polygons has one value per input face") {
  Mesh mesh = makeCube(12).mesh;  // two triangles a side, in order
  mesh.polygons.firstCorner = {0};
  for (uint32_t side = 0; side < 6; ++side) {
    const Face a = mesh.faces[2 * side], b = mesh.faces[2 * side + 1];
    for (const uint32_t vertex : {a[0], a[1], a[2]}) mesh.polygons.corners.push_back(vertex);
    for (const uint32_t vertex : b)
      if (std::find(a.begin(), a.end(), vertex) == a.end()) mesh.polygons.corners.push_back(vertex);
    mesh.polygons.firstCorner.push_back(mesh.polygons.corners.size());
    mesh.polygons.inputFaceOf.insert(mesh.polygons.inputFaceOf.end(), {side, side});
  }
  const Result result = referenceSession().compute(mesh, allSeeds());
  CHECK(result.sdf.size() == 6);
  CHECK(result.report.faceCount == 6);
  CHECK(result.report.triangleCount == 12);
  Mesh triangles = makeCube(12).mesh;
  const Result each = referenceSession().compute(triangles, allSeeds());
  for (size_t side = 0; side < 6; ++side)
    CHECK(result.sdf[side] == doctest::Approx(0.5 * (each.sdf[2 * side] + each.sdf[2 * side + 1])));
}

TEST_CASE("an inverted sphere is named, and turned over on request") {
  Mesh mesh = makeSphere(500).mesh;
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  const Mesh inverted = mesh;
  const Result kept = vulkanSession().compute(mesh, {});
  CHECK(kept.report.noValueCount == 500);
  CHECK(mesh.faces == inverted.faces);
  const auto naming = std::find_if(kept.report.warnings.begin(), kept.report.warnings.end(),
                                   [](const std::string& w) { return w.find("invert") != std::string::npos; });
  CHECK(naming != kept.report.warnings.end());
  for (const Orientation orientation : {Orientation::Auto, Orientation::Flip}) {
    mesh = inverted;
    Options options;
    options.orientation = orientation;
    const Result turned = vulkanSession().compute(mesh, options);
    CHECK(turned.report.noValueCount == 0);
    CHECK(mesh.faces == makeSphere(500).mesh.faces);
  }
}

TEST_CASE("a mesh without faces, and one with an index out of range, are errors of the input") {
  Mesh empty;
  CHECK_THROWS_AS(referenceSession().compute(empty, {}), Error);
  Mesh broken = makeSphere(20).mesh;
  broken.faces[3][1] = 12;
  CHECK_THROWS_WITH_AS(referenceSession().compute(broken, {}),
                       doctest::Contains("1 face with a vertex that does not exist: the mesh has 12 vertices"), Error);
}

TEST_CASE("a mesh that is all degenerate has no values and is no error") {
  Mesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.faces = {{0, 1, 2}, {2, 1, 0}};
  const Result result = vulkanSession().compute(line, {});
  CHECK(result.report.noValueCount == 2);
  CHECK(result.report.seedCount == 0);
}

TEST_CASE("options out of range are errors of usage") {
  Mesh mesh = makeSphere(80).mesh;
  Options none;
  none.seeds = {.kind = SeedCount::Kind::Share, .share = 0, .count = 0};
  CHECK_THROWS_AS(referenceSession().compute(mesh, none), Error);
  Options rays;
  rays.cone.rayCount = 1025;
  CHECK_THROWS_AS(referenceSession().compute(mesh, rays), Error);
}

TEST_CASE("the reference has no solver on a device") {
  Mesh mesh = makeSphere(80).mesh;
  Options options;
  options.solver = SolverChoice::Cg;
  CHECK_THROWS_WITH_AS(referenceSession().compute(mesh, options), doctest::Contains("--solver cpu"), Error);
}

TEST_CASE("all solvers give the same values") {
  Mesh mesh = makeTorus(3000).mesh;
  Options options;
  options.solverOptions.tolerance = 1e-6;
  options.solver = SolverChoice::Eigen;
  const std::vector<double> eigen = vulkanSession().compute(mesh, options).sdf;
  for (const SolverChoice solver : {SolverChoice::Cg, SolverChoice::Jacobi}) {
    options.solver = solver;
    CHECK(largestRelativeDifference(vulkanSession().compute(mesh, options).sdf, eigen) < 1e-3);
  }
}

TEST_CASE("where a device's float32 does not get to the tolerance, the warnings tell that the CPU went on") {
  Mesh mesh = makeTorus(1000).mesh;
  Options options;
  options.solver = SolverChoice::Cg;
  const auto tellsOfCpu = [&] {
    const std::vector<std::string> warnings = vulkanSession().compute(mesh, options).report.warnings;
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("the CPU carried on in double precision") != std::string::npos;
    });
  };
  CHECK_FALSE(tellsOfCpu());
  options.solverOptions.tolerance = 1e-30;
  CHECK(tellsOfCpu());
}

TEST_CASE("a computation stops when it is asked to") {
  Mesh mesh = makeSphere(50'000).mesh;
  std::stop_source stop;
  RunControl control{stop.get_token(), [&](double fraction) {
                       if (fraction > 0.05) stop.request_stop();
                     }};
  try {
    (void)vulkanSession().compute(mesh, allSeeds(), control);
    FAIL("it ran to the end");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Cancelled);
  }
  Mesh small = makeSphere(80).mesh;
  CHECK(vulkanSession().compute(small, {}).report.noValueCount == 0);  // the session goes on
}

TEST_CASE("progress goes from 0 to 1 and never back") {
  Mesh mesh = makeSphere(20'000).mesh;
  double last = 0;
  bool monotonic = true;
  RunControl control{{}, [&](double fraction) {
                       monotonic = monotonic && fraction >= last && fraction <= 1;
                       last = fraction;
                     }};
  (void)vulkanSession().compute(mesh, {}, control);
  CHECK(monotonic);
  CHECK(last > 0.5);
}

TEST_CASE("stages that ran took time, those that did not took none, and no moment counts twice") {
  std::vector<Session*> sessions{&referenceSession(), &vulkanSession()};
  std::optional<Session> embree;
  if (hasEmbree()) sessions.push_back(&embree.emplace(SessionOptions{.backend = Backend::Cpu}));
  Mesh mesh = makeTorus(3000).mesh;
  for (Session* session : sessions) {
    const Stopwatch watch;
    const Report report = session->compute(mesh, {}).report;
    const double total = watch.seconds();
    CAPTURE(report.backend);
    const StageSeconds& seconds = report.stageSeconds;
    double sum = 0;
    for (const auto& [name, member] : kStages) {
      CAPTURE(name);
      const std::string stage = name;
      const bool isOfDevice = stage == "upload", isOfProgram = stage == "read" || stage == "write";
      const bool runs = isOfDevice ? report.backend == "vulkan" : !isOfProgram && stage != "smooth";
      CHECK((seconds.*member > 0) == runs);
      sum += seconds.*member;
    }
    CHECK(sum <= total);
  }
}

TEST_CASE("a backend of the CPU contradicts a required GPU") {
  for (const Backend backend : {Backend::Cpu, Backend::Reference})
    CHECK_THROWS_WITH_AS(Session({.backend = backend, .requireGpu = true}), doctest::Contains("a GPU was required"),
                         Error);
  CHECK_THROWS_WITH_AS(Session({.backend = Backend::Cpu, .trace = {.kernel = TraceKernel::Ray}}),
                       doctest::Contains("a variant of the shaders was asked for"), Error);
}

TEST_CASE("Embree gives the reference's values and the check treats it as independent") {
  if (!hasEmbree()) {
    CHECK_THROWS_WITH_AS(Session({.backend = Backend::Cpu}), doctest::Contains("libembree-dev"), Error);
    return;
  }
  Session session({.backend = Backend::Cpu});
  Mesh mesh = makeTorus(4000).mesh;
  Options options = allSeeds();
  options.checkCount = 4000;
  const Report report = session.compute(mesh, options).report;
  CHECK(report.backend == "cpu");
  CHECK(report.runsOnCpu);
  REQUIRE(report.check);
  CHECK(report.check->isIndependent);
  CHECK(report.check->tracedCount > 3000);
  CHECK(report.check->passed);
  options.solver = SolverChoice::Cg;
  options.seeds = {};
  CHECK_THROWS_WITH_AS((void)session.compute(mesh, options), doctest::Contains("--backend vulkan"), Error);
}

TEST_CASE("a CPU device is refused where a GPU is required") {
  for (const DeviceInfo& device : listDevices(nullptr))
    if (device.kind != "CPU") return;
  CHECK_THROWS_WITH_AS(Session({.backend = Backend::Auto, .requireGpu = true}), doctest::Contains("a GPU was required"),
                       Error);
  CHECK_THROWS_AS(Session({.backend = Backend::Vulkan, .device = "no such device"}), Error);
}
