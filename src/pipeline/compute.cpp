#include "pipeline/compute.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "asdf_vk/error.h"
#include "core/free_memory.h"
#include "core/length_unit.h"
#include "core/parallel.h"
#include "describe/computation_options.h"
#include "describe/fields.h"
#include "describe/findings.h"
#include "estimate/reference_check.h"
#include "pipeline/aggregated_mesh.h"
#include "pipeline/input_face_values.h"
#include "pipeline/rounds.h"
#include "pipeline/seed_choice.h"
#include "pipeline/segments.h"
#include "pipeline/skeleton_points.h"
#include "pipeline/surface_measures.h"
#include "pipeline/value_report.h"
#include "pipeline/vertex_fields.h"
#include "poisson/poisson_solver.h"
#include "smooth/bilateral.h"
#include "trace/scene_data.h"

namespace asdfvk {
namespace {

/// Progress at which the comparison with the reference begins.
constexpr double kRoundsEndBeforeCheck = 0.6;

void describeBackend(Report& report, const NamedBackend& named) {
  report.backend = named.name;
  report.device = named.backend->deviceName();
  report.runsOnCpu = named.backend->runsOnCpu();
}

KernelNeeds kernelNeedsOf(const Computation& computation) {
  return {.rayCount = static_cast<uint32_t>(computation.cone.directions.size()),
          .definition = computation.cone.definition,
          .hits = computation.keepsHits(),
          .predicts = computation.keepsHits(),
          .solves = computation.options.seeds.kind != SeedCount::Kind::All,
          .solver = computation.options.solver};
}

void describeMesh(Report& report, const PreparedMesh& prepared, const InputFaceSet& region) {
  report.faceCount = prepared.mesh.inputFaceCount();
  report.regionFaceCount =
      region.hasAll() ? report.faceCount
                      : countInParallel(region.flags.size(), [&](uint32_t face) { return region.contains(face); });
  report.triangleCount = prepared.mesh.faceCount();
  report.vertexCount = prepared.mesh.vertices.size();
  report.componentCount = prepared.components.components.size();
  report.size = prepared.geometry.bounds.size();
  report.unit = prepared.unit;
  report.chordError = prepared.chordError;
  report.defects = prepared.defects;
  report.reversedFaceCount = prepared.reversedFaces.size();
  report.warnings = prepared.warnings;
}

void describeRounds(Report& report, const RoundsResult& rounds) {
  report.seedCount = rounds.seeds.size();
  report.rayCount = rounds.seeds.statistics.rayCount;
  report.redoneConeCount = rounds.seeds.statistics.redoneConeCount;
  const double traceSeconds = report.stageSeconds[Stage::Trace];
  report.raysPerSecond = traceSeconds > 0 ? static_cast<double>(report.rayCount) / traceSeconds : 0;
  report.traceChoice = rounds.traceVariant;
  report.solver = rounds.interpolated.solver;
  report.clampedCount = rounds.interpolated.clampedCount;
  report.roundCount = rounds.roundCount;
}

/// Values of all faces of the mesh, #F.
struct FaceValues {
  std::vector<double> values;
  UnsetVector<double> expectedErrors;  ///< Empty without an estimate.
  std::vector<uint8_t> isSeed;
};

/// Removes the values, and the expected errors, of traced and of degenerate faces that have no value of their own.
void removeMissing(const PreparedMesh& prepared, const Seeds& seeds, FaceValues& faces) {
  const auto remove = [&](uint32_t face) {
    faces.values[face] = kNoValue;
    if (!faces.expectedErrors.empty()) faces.expectedErrors[face] = 0;
  };
  for (size_t seed = 0; seed < seeds.size(); ++seed)
    if (std::isnan(seeds.values[seed])) remove(seeds.nodes[seed]);
  for (uint32_t face = 0; face < faces.values.size(); ++face)
    if (prepared.geometry.isDegenerate(face)) remove(face);
}

/// Removes the expected errors of faces outside of the domain, which are unknown.
void removeErrorsOutside(const FaceDomain& domain, UnsetVector<double>& expected) {
  if (domain.faces.empty()) return;
  expected = atFaces(domain, entriesAt<UnsetVector<double>>(domain.faces, expected), expected.size(), kNoValue);
}

std::vector<Field> fieldsOf(const PreparedMesh& prepared, FaceValues&& faces, SegmentedValues&& segmented) {
  const std::span<const double> areas = prepared.geometry.areas;
  std::vector<Field> fields;
  fields.push_back(makeField("sdf", valuesOfInputFaces(prepared.mesh, std::move(faces.values), areas)));
  fields.push_back(makeField("seed", seedsOfInputFaces(prepared.mesh, faces.isSeed)));
  if (const UnsetVector<double>& expected = faces.expectedErrors; !expected.empty())
    fields.push_back(makeField("error", valuesOfInputFaces(prepared.mesh, {expected.begin(), expected.end()}, areas)));
  if (!segmented.normalized.empty())
    fields.push_back(
        makeField("normalized", valuesOfInputFaces(prepared.mesh, std::move(segmented.normalized), areas)));
  if (!segmented.segments.empty()) fields.push_back(makeField("segment", std::move(segmented.segments)));
  if (!segmented.boundaryStability.empty())
    fields.push_back(makeField("boundary_stability", std::move(segmented.boundaryStability)));
  return fields;
}

void addDerivedFields(std::vector<Field>& fields, const PreparedMesh& prepared, const Options& options) {
  if (options.computesCentres) {
    fields.push_back(makeField(
        "centre", centresOfInputFaces(prepared.mesh, prepared.geometry, *requireField(fields, "sdf").reals())));
    fields.push_back(makeField(
        "component", labelsOfInputFaces(prepared.mesh, prepared.components.componentOf, prepared.geometry.areas)));
  }
  if (options.per != PerElement::Vertices) return;
  std::vector<Field> further = vertexFieldsOf(prepared.mesh, prepared.vertexOf, prepared.geometry.areas, fields);
  fields.insert(fields.end(), std::make_move_iterator(further.begin()), std::make_move_iterator(further.end()));
}

/// The values of the triangles, smoothed if requested.
std::vector<double> finalValues(const FaceDomain& domain, std::vector<double> values, const SmoothingOptions& smoothing,
                                StageClock& clock, const RunControl& stopOnly) {
  if (!smoothing.isOn) return values;
  const auto scope = clock.time(Stage::Smooth);
  const size_t faceCount = values.size();
  const SmoothingOptions::Window window =
      smoothing.window.value_or(smoothingWindowFor(static_cast<uint32_t>(faceCount)));
  return atFaces(domain, smoothBilaterally(domain.graph, atNodes(domain, std::move(values)), window, stopOnly),
                 faceCount, kNoValue);
}

/// Spreads the results of the rounds over the faces: the nodes of the seeds become faces. aggregated: the mesh of the
/// domain, or null.
RoundsResult onFaces(RoundsResult rounds, const FaceDomain& domain, const AggregatedMesh* aggregated,
                     size_t faceCount) {
  rounds.seeds.freeHits();  // With RoundOptions, runRounds() keeps them for further rounds.
  for (uint32_t& node : rounds.seeds.nodes) node = domain.faceOf(node);
  std::vector<double>& values = rounds.interpolated.values;
  if (aggregated != nullptr) {
    values = aggregated->spreadValues(std::move(values));
    if (!rounds.indicator.empty()) rounds.indicator = aggregated->spreadEntries(rounds.indicator);
    return rounds;
  }
  values = atFaces(domain, std::move(values), faceCount, kNoValue);
  if (!rounds.indicator.empty()) rounds.indicator = atFaces(domain, std::move(rounds.indicator), faceCount, kNoValue);
  return rounds;
}

/// Calls runRounds(), on fine meshes for the centres of aggregates only. If these leave a component without a value,
/// calls it for all faces.
RoundsResult runRoundsOnFaces(const Computation& computation, const RaySource& source, const RunControl& control) {
  const auto& [options, prepared, domain, region, scene, cone, backend, clock, warnings] = computation;
  const auto runOnDomain = [&](const Computation& on, const AggregatedMesh* aggregated) {
    RoundsResult rounds = runRounds(on, source, control);
    const auto scope = on.clock.time(Stage::Solve);
    return onFaces(std::move(rounds), on.domain, aggregated, on.prepared.mesh.faceCount());
  };
  const bool mayAggregate = computation.predicts() && options.seeds.kind != SeedCount::Kind::All &&
                            !options.rounds.areSet() && region.hasAll() && !domain.traceable.empty();
  if (!mayAggregate) return runOnDomain(computation, nullptr);
  const uint64_t seedCount = resolveSeedCount(options, domain.traceable.size());
  std::unique_ptr<const AggregatedMesh> aggregated;
  {
    const auto scope = clock.time(Stage::Sample);
    aggregated = aggregatesFor(prepared, seedCount, options.interpolation.pooling > 0);
  }
  if (!aggregated) return runOnDomain(computation, nullptr);
  const FaceDomain centres = aggregated->domain();
  Options counted = options;  // A share would be a share of the centres.
  counted.seeds = SeedCount::ofCount(seedCount);
  control.checkpoint(0);
  RoundsResult rounds =
      runOnDomain({counted, prepared, centres, region, scene, cone, backend, clock, warnings}, aggregated.get());
  const bool hasUntried = !untriedWithoutValue(domain, rounds.seeds, [](size_t) { return true; }).empty();
  return hasUntried ? runOnDomain(computation, nullptr) : std::move(rounds);
}

FaceValues faceValuesOf(const Computation& computation, RoundsResult& rounds, Report& report) {
  FaceValues faces{std::move(rounds.interpolated.values), {}, {}};
  faces.isSeed = seedFlags(rounds.seeds, faces.values.size());
  if (rounds.errors) {
    const auto scope = computation.clock.time(Stage::Estimate);
    faces.expectedErrors = expectedErrors(*rounds.errors, rounds.seeds, faces.values, rounds.indicator);
    report.estimatedError = rounds.errors->estimate;
  }
  if (computation.keepsMissing()) removeMissing(computation.prepared, rounds.seeds, faces);
  if (rounds.errors) removeErrorsOutside(computation.domain, faces.expectedErrors);
  return faces;
}

void measureDiameter(Result& result, const Computation& computation, const RaySource& source,
                     const RunControl& control) {
  const auto& [options, prepared, domain, region, scene, cone, backend, clock, warnings] = computation;
  Report& report = result.report;
  const double roundsEnd = options.checkCount ? kRoundsEndBeforeCheck : 1;
  RoundsResult rounds = runRoundsOnFaces(computation, source, control.part(0, roundsEnd));
  describeRounds(report, rounds);
  FaceValues faces = faceValuesOf(computation, rounds, report);
  const RunControl stopOnly = control.withoutProgress();
  faces.values = finalValues(domain, std::move(faces.values), options.smoothing, clock, stopOnly);
  SegmentedValues segmented =
      segmentValues(prepared, faces.values, options, makeLineOfSight(scene, backend->isReference(), stopOnly), clock,
                    report, stopOnly);
  if (options.checkCount)
    report.check = checkAgainstReference(scene, cone, facesAt(domain, domain.traceable),
                                         {rounds.seeds, faces.isSeed, faces.values, backend->isReference()},
                                         *options.checkCount, options.randomSeed, control.part(roundsEnd, 1));
  result.fields = fieldsOf(prepared, std::move(faces), std::move(segmented));
  describeValues(report, prepared, region, result.sdf(), computation.keepsMissing());
}

/// The scene for pictures. A scene that is not used again keeps nothing else.
std::shared_ptr<const SceneData> sceneData(const std::shared_ptr<PreparedScene>& scene, bool isLast) {
  if (isLast) {
    PreparedMesh& prepared = scene->prepared;
    prepared.graph = {};
    prepared.components = {};
    freeMemory(prepared.traceableFaces);
  }
  return std::make_shared<SceneData>(SceneData{scene, scene->view()});
}

/// Converts a limit to the unit of the mesh.
void convertToUnit(std::optional<LengthLimit>& limit, const std::string& unit) {
  if (!limit) return;
  const LengthUnitRow *const from = findLengthUnit(limit->unit), *const to = findLengthUnit(unit);
  if (from == nullptr) return;
  if (to == nullptr)
    throw Error(ErrorCode::OptionConflict,
                fmt::format("the limit is in {}, and the mesh states no unit; give a plain number, in the unit of the "
                            "mesh (3MF, glTF and STEP files state a unit)",
                            from->name));
  limit = limit->value * from->micrometres / to->micrometres;
}

/// Sets SeedCount::all() if every face becomes a seed: then nothing is interpolated, and no hit has to be kept.
Options withAllSeeds(Options options, const FaceDomain& domain) {
  const uint64_t faceCount = domain.traceable.size();
  if (faceCount > 0 && resolveSeedCount(options, faceCount) == faceCount) options.seeds = SeedCount::all();
  return options;
}

}  // namespace

void computeOn(const ComputationInput& input, const CheckedOptions& requested, StageClock& clock,
               const RunControl& control, Result& result) {
  Report& report = result.report;
  const auto& [session, sharedScene, part, tracers, former] = input;
  const PreparedMesh& prepared = sharedScene->prepared;
  const FaceDomain domain = part != nullptr ? part->domain() : wholeMesh(prepared);
  const InputFaceSet region = part != nullptr ? part->inputFaces() : InputFaceSet();
  const bool isLast = tracers == nullptr;
  Options options = withAllSeeds(*requested, domain);
  for (std::optional<LengthLimit>* const limit :
       {&options.thickness.thinnerThan, &options.thickness.thickerThan, &options.thickness.closerThan})
    convertToUnit(*limit, prepared.unit);
  const Cone cone = makeCone(options.cone);
  const uint64_t rayCount = resolveSeedCount(options, domain.traceable.size()) * cone.directions.size();
  LazyBackend& backend = isLast ? session.backendFor(options, rayCount, report) : *session.backend;
  if (backend.isDecided()) (void)backend.openFor(requested->solver, control.stop);  // The backend may have changed.
  report.randomSeed = options.randomSeed;
  describeMesh(report, prepared, region);
  result.reversedFaces = prepared.reversedFaces;
  report.warnings.insert(report.warnings.end(), session.warnings().begin(), session.warnings().end());

  const TraceScene scene = sharedScene->view();
  const Computation computation{options, prepared, domain, region, scene, cone, backend, clock, report.warnings};
  const bool keepsNodes = !isLast || options.checkCount || options.keepsScene || options.measuresThickness() ||
                          options.measuresGap() || options.segmentation == Segmentation::Parts;
  DeviceTimes deviceTimes;
  const StageClock::DeviceWatch watch(
      clock, [&] { return backend.deviceSeconds(); }, deviceTimes);
  if (options.measuresDiameter()) {
    backend.prepare(kernelNeedsOf(computation));
    measureDiameter(result, computation, {*sharedScene, tracers, keepsNodes}, control);
  }
  const NamedBackend& opened = backend.open(control.stop);
  describeBackend(report, opened);
  if (options.measuresThickness() || options.measuresGap()) {
    opened.backend->requireSolver(options.solver);
    sharedScene->requireHierarchy(opened.backend->bvhOptions(), clock, control.withoutProgress());
    measureSurfaces(result, computation, *sharedScene, former,
                    options.measuresDiameter() ? control.withoutProgress() : control);
  }
  report.findings = findingsOf(report);
  if (opened.backend->deviceSeconds()) {
    const double seconds = deviceTimes.kernels[Stage::Trace];
    deviceTimes.raysPerSecond = seconds > 0 ? static_cast<double>(report.rayCount) / seconds : 0;
    report.deviceTimes = deviceTimes;
  }
  addDerivedFields(result.fields, prepared, options);
  opened.backend->requireSilentValidation();
  if (options.keepsScene) result.scene = sceneData(sharedScene, isLast);
}

}  // namespace asdfvk
