#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "asdf_vk/error.h"
#include "asdf_vk/session.h"
#include "core/stopwatch.h"
#include "generate/shapes.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/vk/vulkan_backend.h"
#include "support/require_failure.h"
#include "support/shapes.h"
#include "support/shared_session.h"
#include "support/test_device.h"
#include "trace/cone_tracer.h"

using namespace asdfvk;
using test::allSeeds;
using test::findWarning;
using test::referenceSession;
using test::requireFailure;
using test::vulkanSession;

namespace {

/// Whether the solvers on the device run there.
bool hasDeviceSolvers() {
  static const bool has =
      test::hasBuffersForSolvers(*vulkanDeviceOf(*openBackend({.backend = BackendChoice::Vulkan}).backend));
  return has;
}

double largestRelativeDifference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double each = std::abs(a[i] - b[i]) / std::abs(b[i]);
    if (!(each <= largest)) largest = each;  // NaN too
  }
  return largest;
}

}  // namespace

TEST_CASE("a tenth of the faces casts rays and every face gets a value") {
  const Mesh mesh = makeSphere(2000).mesh;
  const Result result = vulkanSession().compute(mesh, test::tenthOfFaces());
  CHECK(result.sdf().size() == mesh.faces.size());
  CHECK(result.report.seedCount == 200);
  CHECK(result.report.rayCount == 6000);
  CHECK(std::count(result.seed().begin(), result.seed().end(), 1) == 200);
  CHECK(result.report.noValueCount == 0);
  CHECK(result.report.backend == "vulkan");
  CHECK(result.report.solver.relativeResidual <= 1e-4);
  CHECK(result.report.solver.converged);
  CHECK(result.report.componentCount == 1);
  CHECK(result.report.warnings.empty());
}

TEST_CASE("without guidance interpolated values stay within the range of the seeds") {
  const Mesh mesh = makeTorus(3000).mesh;
  Options options = test::tenthOfFaces();
  options.interpolation.guidance = Guidance::None;
  const Result result = vulkanSession().compute(mesh, options);
  double low = 1e30, high = -1e30;
  for (size_t f = 0; f < result.sdf().size(); ++f)
    if (result.seed()[f]) low = std::min(low, result.sdf()[f]), high = std::max(high, result.sdf()[f]);
  CHECK(result.report.sdf.min >= low - 1e-4 * (high - low));
  CHECK(result.report.sdf.max <= high + 1e-4 * (high - low));
}

TEST_CASE("two runs give the same bits") {
  const Mesh mesh = makeTorus(2000).mesh;
  for (const SolverChoice solver : {SolverChoice::Eigen, hasDeviceSolvers() ? SolverChoice::Cg : SolverChoice::Cpu}) {
    Options options = test::tenthOfFaces();
    options.solver = solver;
    CHECK(vulkanSession().compute(mesh, options).sdf() == vulkanSession().compute(mesh, options).sdf());
  }
}

TEST_CASE("another random seed chooses other faces") {
  const Mesh mesh = makeTorus(2000).mesh;
  Options other;
  other.randomSeed = 2;
  CHECK(vulkanSession().compute(mesh, test::tenthOfFaces()).seed() != vulkanSession().compute(mesh, other).seed());
}

TEST_CASE("scaling and shifting a mesh scales its values and nothing else") {
  const Mesh mesh = makeTorus(2000).mesh;
  const std::vector<double> expected = vulkanSession().compute(mesh, allSeeds()).sdf();
  const struct {
    double scale;
    Vec3d shift;
  } cases[] = {{1e-3, {0, 0, 0}},  {1e3, {0, 0, 0}},      {1e-170, {0, 0, 0}}, {1e160, {0, 0, 0}},
               {1e307, {0, 0, 0}}, {1, {1e6, -2e6, 3e5}}, {1e3, {1e8, 0, 0}}};
  for (const auto& [size, shift] : cases) {
    const double scale = size;
    CAPTURE(scale);
    const Mesh moved = shapes::scaledAndShifted(mesh, scale, shift);
    std::vector<double> values = vulkanSession().compute(moved, allSeeds()).sdf();
    for (double& value : values) value /= scale;
    // A ray that grazes an edge may change sides with the last bit of a coordinate.
    uint64_t differing = 0;
    for (size_t f = 0; f < values.size(); ++f) differing += std::abs(values[f] - expected[f]) > 1e-4 * expected[f];
    CHECK(differing <= values.size() / 1000);
  }
}

TEST_CASE("options out of range are errors, also where nothing uses them") {
  const Mesh mesh = makeSphere(80).mesh;
  const auto requireRefusal = [&](const char* part, const auto& set) {
    Options options = test::tenthOfFaces();
    options.seeds = SeedCount::all();
    set(options);
    requireFailure([&] { (void)referenceSession().compute(mesh, options); }, ErrorCode::OptionOutOfRange, part);
  };
  requireRefusal("seeds: '0%' is not a share", [](Options& options) { options.seeds = SeedCount::ofShare(0); });
  requireRefusal("seeds: '0' is not a share", [](Options& options) { options.seeds = SeedCount::ofCount(0); });
  requireRefusal("rays: 1025 is not a whole number from 1 to 1024",
                 [](Options& options) { options.cone.rayCount = 1025; });
  requireRefusal("tolerance: 0 is not a number above 0 and below 1",
                 [](Options& options) { options.solverOptions.tolerance = 0; });
  requireRefusal("tolerance: 1 is not", [](Options& options) { options.solverOptions.tolerance = 1; });
  requireRefusal("maxIterations: 0 is not", [](Options& options) { options.solverOptions.maxIterations = 0; });
  requireRefusal("check: 0 is not a count", [](Options& options) { options.checkCount = 0; });
  requireRefusal("maxError: 1 is not an error", [](Options& options) { options.rounds.maxError = 1; });
  Options options = test::tenthOfFaces();
  options.seeds = SeedCount::all();
  options.solver = static_cast<SolverChoice>(99);
  requireFailure([&] { (void)referenceSession().compute(mesh, options); }, ErrorCode::UnknownName, "solver");
}

TEST_CASE("the reference has no solver on a device") {
  const Mesh mesh = makeSphere(80).mesh;
  Options options = test::tenthOfFaces();
  options.solver = SolverChoice::Cg;
  requireFailure([&] { (void)referenceSession().compute(mesh, options); }, ErrorCode::NoDeviceForKernel,
                 "the solver cg runs on a Vulkan device");
}

TEST_CASE("all solvers give the same values") {
  if (!hasDeviceSolvers()) return;
  const Mesh mesh = makeTorus(3000).mesh;
  Options options = test::tenthOfFaces();
  options.solverOptions.tolerance = 1e-6;
  options.solver = SolverChoice::Eigen;
  const std::vector<double> eigen = vulkanSession().compute(mesh, options).sdf();
  for (const SolverChoice solver : {SolverChoice::Cg, SolverChoice::Jacobi}) {
    options.solver = solver;
    CHECK(largestRelativeDifference(vulkanSession().compute(mesh, options).sdf(), eigen) < 1e-3);
  }
}

TEST_CASE("a warning reports that the CPU finished where float32 of the device does not reach the tolerance") {
  if (!hasDeviceSolvers()) return;
  const Mesh mesh = makeTorus(1000).mesh;
  Options options = test::tenthOfFaces();
  options.solver = SolverChoice::Cg;
  const auto finishedOnCpu = [&] {
    const Report report = vulkanSession().compute(mesh, options).report;
    const bool isWarned = findWarning(report, WarningCode::FinishedOnCpu) != nullptr;
    CHECK(report.solver.finishedOnCpu == isWarned);
    CHECK(report.solver.name == "cg");
    return isWarned;
  };
  CHECK_FALSE(finishedOnCpu());
  options.solverOptions.tolerance = 1e-30;
  CHECK(finishedOnCpu());
}

TEST_CASE("a stop request ends a computation, and the session stays usable") {
  const Mesh mesh = makeSphere(50'000).mesh;
  std::stop_source stop;
  RunControl control{stop.get_token(), [&](double fraction) {
                       if (fraction > 0.05) stop.request_stop();
                     }};
  try {
    (void)vulkanSession().compute(mesh, allSeeds(), control);
    FAIL("no exception");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Cancelled);
  }
  CHECK(vulkanSession().compute(makeSphere(80).mesh).report.noValueCount == 0);
}

TEST_CASE("a stop request ends the preparation of a mesh at any of its checkpoints") {
  const Mesh mesh = makeSphere(80).mesh;
  const auto prepare = [&](int stopAt) {
    std::stop_source stop;
    int callCount = 0;
    const RunControl control{stop.get_token(),
                             [&](double) {
                               if (++callCount == stopAt) stop.request_stop();
                             },
                             {}};
    StageSeconds seconds;
    StageClock clock(seconds);
    (void)prepareMesh(mesh, Orientation::Keep, clock, control);
    return callCount;
  };
  const int count = prepare(0);
  CHECK(count > 5);
  for (int stopAt = 1; stopAt < count; ++stopAt) requireFailure([&] { (void)prepare(stopAt); }, ErrorCode::Cancelled);
}

TEST_CASE("progress goes from 0 to 1 and never back") {
  const Mesh mesh = makeSphere(20'000).mesh;
  double last = 0;
  bool monotonic = true;
  RunControl control{{}, [&](double fraction) {
                       monotonic = monotonic && fraction >= last && fraction <= 1;
                       last = fraction;
                     }};
  (void)vulkanSession().compute(mesh, test::tenthOfFaces(), control);
  CHECK(monotonic);
  CHECK(last > 0.5);
}

TEST_CASE("stages that ran have a time, others have 0, and no time is counted twice") {
  std::vector<Session*> sessions{&referenceSession(), &vulkanSession()};
  Session cpu({.backend = BackendChoice::Cpu});
  sessions.push_back(&cpu);
  const Mesh mesh = makeTorus(3000).mesh;
  for (Session* session : sessions) {
    const Stopwatch watch;
    const Report report = session->compute(mesh, test::tenthOfFaces()).report;
    const double total = watch.seconds();
    CAPTURE(report.backend);
    const StageSeconds& seconds = report.stageSeconds;
    double sum = 0;
    for (size_t i = 0; i < kStageCount; ++i) {
      const auto stage = static_cast<Stage>(i);
      CAPTURE(nameOf(stage));
      const bool isOfProgram = stage == Stage::Read || stage == Stage::Write;
      const bool isOptional =
          stage == Stage::Thickness || stage == Stage::Smooth || stage == Stage::Postprocess || stage == Stage::Segment;
      const bool runs = stage == Stage::Upload ? report.backend == "vulkan" : !isOfProgram && !isOptional;
      CHECK((seconds[stage] > 0) == runs);
      sum += seconds[stage];
    }
    CHECK(sum <= total);
  }
}

TEST_CASE("the CPU tracer gives the values of the reference, and the check treats it as independent") {
  Session session({.backend = BackendChoice::Cpu});
  const Mesh mesh = makeTorus(4000).mesh;
  Options options = allSeeds();
  options.checkCount = 4000;
  const Report report = session.compute(mesh, options).report;
  CHECK(report.backend == "cpu");
  CHECK(report.runsOnCpu);
  REQUIRE(report.check);
  CHECK(report.check->independent);
  CHECK(report.check->tracedCount > 3000);
  CHECK(report.check->passed == true);
  options.solver = SolverChoice::Cg;
  options.seeds = {};
  requireFailure([&] { (void)session.compute(mesh, options); }, ErrorCode::NoDeviceForKernel, "the solver cg");
}
