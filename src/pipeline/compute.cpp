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
#include "estimate/reference_check.h"
#include "pipeline/aggregated_mesh.h"
#include "pipeline/input_face_values.h"
#include "pipeline/rounds.h"
#include "pipeline/seed_choice.h"
#include "pipeline/seed_tracing.h"
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

void describeMesh(Report& report, const PreparedMesh& prepared, const FaceDomain& domain) {
  report.faceCount = prepared.mesh.inputFaceCount();
  report.regionFaceCount = domain.inputFaces.empty() ? report.faceCount
                                                     : countInParallel(domain.inputFaces.size(),
                                                                       [&](uint32_t i) { return domain.contains(i); });
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
  report.seedCount = rounds.traced.faces.size();
  report.rayCount = rounds.traced.statistics.rayCount;
  report.redoneConeCount = rounds.traced.statistics.redoneConeCount;
  const double traceSeconds = report.stageSeconds[Stage::Trace];
  report.raysPerSecond = traceSeconds > 0 ? static_cast<double>(report.rayCount) / traceSeconds : 0;
  report.traceChoice = rounds.traceVariant;
  report.solver = rounds.interpolated.solver;
  report.clampedCount = rounds.interpolated.clampedCount;
  report.roundCount = rounds.roundCount;
  if (rounds.errors) report.estimatedError = rounds.errors->estimate;
}

/// Removes the values, and the expected errors, of traced and of degenerate faces that have no value of their own.
void removeMissing(const PreparedMesh& prepared, RoundsResult& rounds) {
  for (uint32_t face = 0; face < rounds.interpolated.values.size(); ++face) {
    const bool isTraced = rounds.traced.isSeed[face];
    if (!prepared.geometry.isDegenerate(face) && !(isTraced && std::isnan(rounds.traced.values[face]))) continue;
    rounds.interpolated.values[face] = kNoValue;
    if (rounds.errors) rounds.errors->expected[face] = 0;
  }
}

void removeErrorsOutside(const PreparedMesh& prepared, const FaceDomain& domain, EstimatedErrors& errors) {
  if (domain.inputFaces.empty()) return;
  for (uint32_t face = 0; face < errors.expected.size(); ++face)
    if (!domain.contains(prepared.mesh.inputFaceOf(face))) errors.expected[face] = kNoValue;
}

std::vector<Field> fieldsOf(const PreparedMesh& prepared, const RoundsResult& rounds, std::vector<double> values,
                            SegmentedValues&& segmented) {
  const std::span<const double> areas = prepared.geometry.areas;
  std::vector<Field> fields;
  fields.push_back(makeField("sdf", valuesOfInputFaces(prepared.mesh, std::move(values), areas)));
  fields.push_back(makeField("seed", seedsOfInputFaces(prepared.mesh, rounds.traced.isSeed)));
  if (rounds.errors) {
    const UnsetVector<double>& expected = rounds.errors->expected;
    fields.push_back(makeField("error", valuesOfInputFaces(prepared.mesh, {expected.begin(), expected.end()}, areas)));
  }
  if (!segmented.normalized.empty())
    fields.push_back(
        makeField("normalized", valuesOfInputFaces(prepared.mesh, std::move(segmented.normalized), areas)));
  if (!segmented.segments.empty()) fields.push_back(makeField("segment", std::move(segmented.segments)));
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
  return smoothBilaterally(domain.graph, values,
                           smoothing.window.value_or(smoothingWindowFor(domain.graph.faceCount())), stopOnly);
}

/// Calls runRounds(), on fine meshes for the centres of aggregates only. If these leave a component without a value,
/// calls it for all faces. keepsNodes: whether the nodes of the hierarchy are needed after the rounds.
RoundsResult runRoundsOnAggregates(const Computation& computation, PreparedScene& preparedScene, KeptTracers& tracers,
                                   bool keepsNodes, const RunControl& control) {
  const auto run = [&](const Computation& on) {
    const auto makeTracing = [&] {
      preparedScene.requireHierarchy(bvhOptionsFor(on.backend), on.clock, control.withoutProgress());
      return std::make_unique<SeedTracing>(on, tracers, keepsNodes ? nullptr : &preparedScene.bvh);
    };
    return runRounds(on, makeTracing, control);
  };
  const auto& [options, prepared, domain, scene, cone, backend, solvers, clock, warnings] = computation;
  const bool mayAggregate = computation.predicts() && options.seeds.kind != SeedCount::Kind::All &&
                            !options.rounds.areSet() && domain.inputFaces.empty() && !domain.traceableFaces.empty();
  if (!mayAggregate) return run(computation);
  const uint64_t seedCount = resolveSeedCount(options, domain.traceableFaces.size());
  std::unique_ptr<const AggregatedMesh> aggregated;
  {
    const auto scope = clock.time(Stage::Sample);
    aggregated = aggregatesFor(prepared, seedCount, options.interpolation.pooling > 0);
  }
  if (!aggregated) return run(computation);
  const FaceDomain centres = aggregated->domain();
  Options counted = options;  // A share would be a share of the centres.
  counted.seeds = SeedCount::ofCount(seedCount);
  control.checkpoint(0);
  RoundsResult rounds = run({counted, prepared, centres, scene, cone, backend, solvers, clock, warnings});
  return untriedWithoutValue(domain, rounds.traced).empty() ? std::move(rounds) : run(computation);
}

/// keepsNodes: see runRoundsOnAggregates().
void measureDiameter(Result& result, const Computation& computation, PreparedScene& preparedScene, KeptTracers& tracers,
                     bool keepsNodes, const RunControl& control) {
  const auto& [options, prepared, domain, scene, cone, backend, solvers, clock, warnings] = computation;
  Report& report = result.report;
  const double roundsEnd = options.checkCount ? kRoundsEndBeforeCheck : 1;
  RoundsResult rounds =
      runRoundsOnAggregates(computation, preparedScene, tracers, keepsNodes, control.part(0, roundsEnd));
  describeRounds(report, rounds);
  if (computation.keepsMissing()) removeMissing(prepared, rounds);
  if (rounds.errors) removeErrorsOutside(prepared, domain, *rounds.errors);
  const RunControl stopOnly = control.withoutProgress();
  std::vector<double> values =
      finalValues(domain, std::move(rounds.interpolated.values), options.smoothing, clock, stopOnly);
  SegmentedValues segmented = segmentValues(
      prepared, values, options, makeLineOfSight(scene, backend.isReference(), stopOnly), clock, report, stopOnly);
  if (options.checkCount)
    report.check =
        checkAgainstReference(scene, cone, domain.traceableFaces, {rounds.traced, values, backend.isReference()},
                              *options.checkCount, options.randomSeed, control.part(roundsEnd, 1));
  result.fields = fieldsOf(prepared, rounds, std::move(values), std::move(segmented));
  describeValues(report, prepared, domain, result.sdf(), computation.keepsMissing());
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
  const uint64_t faceCount = domain.traceableFaces.size();
  if (faceCount > 0 && resolveSeedCount(options, faceCount) == faceCount) options.seeds = SeedCount::all();
  return options;
}

}  // namespace

Options completedFor(const SessionState& session, const Options& options) {
  Options result = completed(options);
  if (result.solver != kAutomaticSolver)
    requireUsable(findSolver(result.solver), session.named.backend->device() != nullptr);
  return result;
}

void computeOn(const ComputationInput& input, const Options& requested, StageClock& clock, const RunControl& control,
               Result& result) {
  Report& report = result.report;
  const auto& [session, sharedScene, domain, tracers, isLast, former] = input;
  Backend& backend = *session.named.backend;
  const PreparedMesh& prepared = sharedScene->prepared;
  // The backend may have changed.
  if (session.named.backend->device() == nullptr) (void)completedFor(session, requested);
  Options options = withAllSeeds(requested, domain);
  for (std::optional<LengthLimit>* const limit :
       {&options.thickness.thinnerThan, &options.thickness.thickerThan, &options.thickness.closerThan})
    convertToUnit(*limit, prepared.unit);
  const Cone cone = makeCone(options.cone);
  describeBackend(report, session.named);
  report.randomSeed = options.randomSeed;
  describeMesh(report, prepared, domain);
  result.reversedFaces = prepared.reversedFaces;
  report.warnings.insert(report.warnings.end(), session.warnings().begin(), session.warnings().end());

  const TraceScene scene = sharedScene->view();
  const Computation computation{options, prepared,        domain, scene,          cone,
                                backend, session.solvers, clock,  report.warnings};
  const bool keepsNodes = !isLast || options.checkCount || options.keepsScene || options.measuresThickness() ||
                          options.measuresGap() || options.segmentation == Segmentation::Parts;
  if (options.measuresDiameter())
    measureDiameter(result, computation, *sharedScene, input.tracers, keepsNodes, control);
  if (options.measuresThickness() || options.measuresGap()) {
    sharedScene->requireHierarchy(bvhOptionsFor(backend), clock, control.withoutProgress());
    measureSurfaces(result, computation, *sharedScene, former,
                    options.measuresDiameter() ? control.withoutProgress() : control);
  }
  addDerivedFields(result.fields, prepared, options);
  backend.requireSilentValidation();
  if (options.keepsScene) result.scene = sceneData(sharedScene, isLast);
}

}  // namespace asdfvk
