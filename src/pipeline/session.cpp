#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "asdf_vk/error.h"
#include "bvh/bvh.h"
#include "core/freed_memory.h"
#include "core/median.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "pipeline/asdf.h"
#include "pipeline/check.h"
#include "pipeline/compute_backend.h"
#include "pipeline/input_faces.h"
#include "pipeline/interpolation.h"
#include "pipeline/missing_values.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/seed_rounds.h"
#include "pipeline/seed_tracing.h"

namespace asdfvk {
namespace {

/// Where a check begins on the progress bar.
constexpr double kRoundsEndBeforeCheck = 0.6;

/// Runs `work` and adds its time to `seconds`.
template <typename Work>
auto timed(double& seconds, const Work& work) {
  const Stopwatch watch;
  auto result = work();
  seconds += watch.seconds();
  return result;
}

ValueRange rangeOf(const std::vector<double>& values) {
  std::vector<double> present;
  std::copy_if(values.begin(), values.end(), std::back_inserter(present), [](double v) { return !std::isnan(v); });
  if (present.empty()) return {};
  const auto [low, high] = std::minmax_element(present.begin(), present.end());
  ValueRange range{*low, 0, *high};
  range.median = upperMedian(present);
  return range;
}

void describeMesh(Report& report, const TriangleMesh& mesh, const PreparedMesh& prepared, const Options& options) {
  report.faceCount = mesh.inputFaceCount();
  report.triangleCount = mesh.faceCount();
  report.vertexCount = mesh.vertices.size();
  report.componentCount = prepared.components.components.size();
  report.defects = prepared.defects;
  report.warnings = prepared.warnings;
  report.randomSeed = options.randomSeed;
}

void describeRounds(Report& report, const SeedRounds& rounds, bool asksForEstimate) {
  report.seedCount = rounds.traced().faces.size();
  report.rayCount = rounds.traced().statistics.rayCount;
  report.redoneConeCount = rounds.traced().statistics.redoneConeCount;
  report.raysPerSecond =
      report.stageSeconds.trace > 0 ? static_cast<double>(report.rayCount) / report.stageSeconds.trace : 0;
  report.solver = rounds.result().solver;
  report.roundCount = rounds.roundCount();
  if (asksForEstimate && rounds.errors()) report.estimatedError = rounds.errors()->estimate;
}

void describeValues(Report& report, const std::vector<double>& sdf, const std::string& causeOfMissing) {
  report.sdf = rangeOf(sdf);
  report.noValueCount =
      static_cast<uint64_t>(std::count_if(sdf.begin(), sdf.end(), [](double v) { return std::isnan(v); }));
  if (report.noValueCount > 0)
    report.warnings.push_back(
        fmt::format("{} of {} without a value: no ray from there, nor from any face that hangs together with it, found "
                    "the other side "
                    "of the shape{}{}",
                    report.noValueCount, counted(report.faceCount, "face"),
                    causeOfMissing.empty() ? "" : ", most likely because ", causeOfMissing));
  if (report.solver.finishedOnCpu)
    report.warnings.push_back(
        fmt::format("the {} solver met the limit of float32 on the device, and the CPU carried on in double precision; "
                    "--solver cpu may be faster here",
                    report.solver.name));
  if (!report.solver.converged)
    report.warnings.push_back(fmt::format(
        "the {} solver stopped after {} at a relative residual of {:.1e}; "
        "raise --max-iterations or --tolerance",
        report.solver.name, counted(report.solver.iterations, "iteration"), report.solver.relativeResidual));
}

void requireAgreement(const Options& options) {
  const auto refuse = [](const char* message) { throw Error(ErrorCode::OptionOutOfRange, message); };
  const InterpolationOptions& interpolation = options.interpolation;
  if (!(interpolation.pooling >= 0 && interpolation.pooling <= 1)) refuse("the pooling is out of range; give 0 to 1");
  if (interpolation.pooling > 0 && interpolation.guidance != Guidance::Hits)
    refuse("pooling takes predictions from hits; use guidance by hits with it");
  (void)requireSampler(options.sampler);
  if (options.smoothing.window) requireValid(*options.smoothing.window);
  if (options.rounds.maxError && !(*options.rounds.maxError > 0)) refuse("the greatest error is not above 0");
  if (options.rounds.timeBudgetSeconds && !(*options.rounds.timeBudgetSeconds > 0))
    refuse("the time budget is not above 0");
}

}  // namespace

struct Session::State {
  explicit State(const SessionOptions& options) : backend(options) {}
  ComputeBackend backend;
};

Session::Session(const SessionOptions& options) : state_(std::make_unique<State>(options)) {}
Session::~Session() = default;

const std::vector<std::string>& Session::deviceLines() const { return state_->backend.deviceLines(); }

Result Session::compute(Mesh& mesh, const Options& options, const RunControl& control) {
  const Stopwatch clock;
  requireAgreement(options);
  ComputeBackend& backend = state_->backend;
  Result result;
  Report& report = result.report;
  StageSeconds& seconds = report.stageSeconds;
  const Cone cone = makeCone(options.cone);
  report.backend = backend.name();
  report.device = backend.deviceName();
  report.traceChoice = backend.traceChoice();
  report.runsOnCpu = backend.runsOnCpu();

  const double roundsEnd = options.checkCount ? kRoundsEndBeforeCheck : 1;
  control.checkpoint(0);
  const PreparedMesh prepared = prepareMesh(mesh, options.orientation, seconds);
  describeMesh(report, mesh, prepared, options);
  control.checkpoint(0);
  Bvh bvh = timed(seconds.bvh, [&] { return buildBvh(mesh, prepared.geometry, prepared.representatives); });
  const TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  control.checkpoint(0);
  const bool interpolates = options.seeds.kind != SeedCount::Kind::All || options.interpolation.pooling > 0;
  const bool wantsHits = interpolates && options.interpolation.guidance == Guidance::Hits;
  const Stopwatch setUpWatch;
  std::unique_ptr<ConeTracer> tracer = backend.makeTracer(scene, cone, wantsHits);
  seconds.encode += tracer->encodeSeconds();
  double& otherSeconds = report.traceChoice ? seconds.upload : seconds.encode;  // Without Vulkan nothing is uploaded.
  otherSeconds += setUpWatch.seconds() - tracer->encodeSeconds();

  SeedTracing tracing(prepared, *tracer, cone.directions.size(), wantsHits);
  Interpolation interpolation(prepared, scene, cone, options, backend, report.warnings);
  const auto afterLastRay = [&] {
    const Stopwatch watch;
    tracer.reset();
    if (!options.checkCount) bvh.nodes = {};  // A check casts rays of its own, and their order is asked for later.
    returnFreedMemory();
    otherSeconds += watch.seconds();
  };
  SeedRounds rounds(mesh, prepared, options, tracing, interpolation, clock, seconds, afterLastRay);
  rounds.run(control.part(0, roundsEnd));
  describeRounds(report, rounds, options.estimatesError || options.rounds.maxError);
  std::vector<double> values = rounds.result().values;
  if (const SmoothingOptions& smoothing = options.smoothing; smoothing.isOn)
    values = timed(seconds.smooth, [&] {
      return smoothBilaterally(prepared.graph, values,
                               smoothing.window.value_or(bilateralOptionsFor(prepared.graph.faceCount())));
    });
  if (options.checkCount)
    report.check = checkAgainstReference(mesh, prepared, scene, cone, {rounds.traced(), values, backend.isReference()},
                                         *options.checkCount, options.randomSeed, control.part(roundsEnd, 1));

  const std::vector<double>& areas = prepared.geometry.areas;
  result.sdf = valuesOfInputFaces(mesh, values, areas);
  result.isSeed = seedsOfInputFaces(mesh, rounds.traced().isSeed);
  if (report.estimatedError) result.expectedError = valuesOfInputFaces(mesh, rounds.errors()->expected, areas);
  describeValues(report, result.sdf, likelyCauseOfMissingValues(mesh, prepared, values));
  backend.requireSilentValidation();
  return result;
}

}  // namespace asdfvk
