#include "asdf_vk/scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/length_unit.h"
#include "core/parallel.h"
#include "core/vec3.h"
#include "describe/computation_options.h"
#include "pipeline/backend.h"
#include "pipeline/compute.h"
#include "pipeline/judged_surface.h"
#include "pipeline/surface_points.h"

namespace asdfvk {
namespace {

/// Number of points that are traced at a time. Their starts take 9 MB.
constexpr size_t kPointChunkSize = 1u << 16;

Vec3d vectorAt(std::span<const double> numbers, size_t i) {
  return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

std::vector<Vec3d> vectorsOf(std::span<const double> numbers) {
  std::vector<Vec3d> vectors(numbers.size() / 3);
  for (size_t i = 0; i < vectors.size(); ++i) vectors[i] = vectorAt(numbers, i);
  return vectors;
}

[[noreturn]] void failAt(size_t point, ErrorCode code, const char* reason) {
  throw Error(code, fmt::format("point {} {}", point, reason), {{"index", std::to_string(point)}});
}

void requirePoints(std::span<const double> points) {
  if (points.size() % 3 != 0)
    throw Error(ErrorCode::ArraySize,
                fmt::format("there are {} coordinates of points; give three per point", points.size()));
  for (size_t i = 0; i < points.size() / 3; ++i)
    if (!isFinite(vectorAt(points, i))) failAt(i, ErrorCode::NonFiniteNumber, "has a coordinate that is not finite");
}

void requirePoints(std::span<const double> points, std::span<const double> normals) {
  if (normals.size() != points.size())
    throw Error(ErrorCode::ArraySize,
                fmt::format("there are {} coordinates of points and {} of normals; give three of each per point",
                            points.size(), normals.size()));
  requirePoints(points);
  for (size_t i = 0; i < normals.size() / 3; ++i) {
    const Vec3d normal = vectorAt(normals, i);
    if (!isFinite(normal)) failAt(i, ErrorCode::NonFiniteNumber, "has a normal with a number that is not finite");
    if (normal == Vec3d{}) failAt(i, ErrorCode::OptionOutOfRange, "has a normal of length 0; give a direction");
  }
}

void requireNoConflict(const Options& options, Orientation orientation, bool hasRegion) {
  if (options.orientation != Orientation::Keep && options.orientation != orientation)
    throw Error(ErrorCode::OptionConflict,
                "the scene was prepared with another orientation; leave the orientation of the options at Keep");
  if (!hasRegion) return;
  if (options.segmentation != Segmentation::None)
    throw Error(ErrorCode::OptionConflict, "a region has no segments; segment the whole mesh");
  if (options.postprocesses())
    throw Error(ErrorCode::OptionConflict, "a region is not post-processed; post-process the whole mesh");
}

/// The distance in the unit of the mesh. For very distant points, where squares overflow, the mesh counts as a point.
double distanceOf(const SurfacePoint& found, const Normalization& unit, const Vec3d& p) {
  constexpr double kFar = 1e100;
  if (found.distance < kFar) return unit.toMeshLength(found.distance);
  const Vec3d way = p - unit.centre;
  return std::min(lengthInAnyUnit(way), std::numeric_limits<double>::max());
}

std::vector<double> valuesWith(const KeptTracer& tracer, const PreparedScene& scene, std::span<const double> points,
                               std::span<const double> normals, const RunControl& control) {
  const Box3d& bounds = scene.prepared.geometry.bounds;
  const Normalization& unit = scene.bvh.normalization;
  const double offset = kPointOffset * length(unit.toNormalized(bounds.max) - unit.toNormalized(bounds.min));
  const size_t count = points.size() / 3;
  std::vector<double> values(count);
  std::vector<ConeStart> starts;
  for (size_t begin = 0; begin < count; begin += kPointChunkSize) {
    const size_t end = std::min(begin + kPointChunkSize, count);
    starts.resize(end - begin);
    forEachInParallel(starts.size(), [&](uint32_t i) {
      const Vec3d normal = unitVector(vectorAt(normals, begin + i));
      starts[i] = coneStartAt(tracer.cone, unit.toNormalized(vectorAt(points, begin + i)) - offset * normal, normal);
    });
    const auto total = static_cast<double>(count);
    tracer.tracer->traceAt(starts, {std::span(values).subspan(begin, starts.size())},
                           control.part(static_cast<double>(begin) / total, static_cast<double>(end) / total));
  }
  control.checkpoint(1);
  return values;
}

}  // namespace

struct Scene::State {
  State(SessionState& theSession, const MeshView& mesh, Orientation theOrientation, const RunControl& control)
      : session(theSession), orientation(theOrientation) {
    StageClock clock(preparation, control.stageBegan);
    scene = std::make_shared<PreparedScene>(prepareMesh(mesh, orientation, clock, control));
    scene->requireHierarchy(session.backend->open(control.stop).backend->bvhOptions(), clock, control);
  }

  ~State() { session.backend->finish(); }  // The thread of a cancelled computation may still use the device.

  /// Tracers of the backend that the session has now.
  KeptTracers& tracers() {
    Backend& backend = **session.backend;
    if (!tracers_ || &tracers_->backend() != &backend)
      tracers_ = std::make_unique<KeptTracers>(backend, scene->view(), kPreparedConeCount);
    return *tracers_;
  }

  /// Throws Error{NoValues} if no face has an area.
  void requireSurface() const {
    if (scene->bvh.nodes.empty()) throw Error(ErrorCode::NoValues, "the mesh has no face with an area");
  }

  /// Calls findNearestPoints(). Throws the error of requireSurface().
  void takeNearest(std::span<const double> points, const RunControl& control,
                   FunctionRef<void(size_t, const SurfacePoint&)> take) const {
    if (!points.empty()) requireSurface();
    findNearestPoints(*scene, vectorsOf(points), control, take);
  }

  /// The surface of the material, found at the first call.
  const JudgedSurface& judgedSurface(const RunControl& control) {
    const std::lock_guard lock(surfaceMutex_);
    if (!surface_)
      surface_ = std::make_unique<JudgedSurface>(*scene, orientation == Orientation::Flip, control.withoutProgress());
    return *surface_;
  }

  /// former: see ComputationInput.
  Result compute(const CheckedOptions& options, std::span<const uint8_t> region, const JudgedSurface* former,
                 const RunControl& control) {
    requireNoConflict(*options, orientation, !region.empty());
    (*session.backend)->requireSolver(options->solver);
    control.checkpoint(0);
    return session.compute(!solverNeedsDevice(options->solver), control, [&](const RunControl& rest) {
      Result result;
      StageClock clock(result.report.stageSeconds, rest.stageBegan);
      const std::optional<Region> part = [&] {
        const auto scope = clock.time(Stage::Sample);
        return regionOf(scene->prepared, region);
      }();
      computeOn({session, scene, part ? &*part : nullptr, &tracers(), former}, options, clock, rest, result);
      return result;
    });
  }

  SessionState& session;
  Orientation orientation;
  StageSeconds preparation;
  std::shared_ptr<PreparedScene> scene;

 private:
  std::unique_ptr<KeptTracers> tracers_;  // Destroyed before the scene.
  std::mutex surfaceMutex_;
  std::unique_ptr<JudgedSurface> surface_;
};

Scene::Scene(Session& session, const MeshView& mesh, Orientation orientation, const RunControl& control)
    : state_(std::make_unique<State>(*session.state_, mesh, orientation, control)) {}
Scene::~Scene() = default;

const StageSeconds& Scene::preparationSeconds() const { return state_->preparation; }

Result Scene::compute(const Options& options, std::span<const uint8_t> region, const RunControl& control) {
  return compute(CheckedOptions(options), region, control);
}

Result Scene::compute(const CheckedOptions& options, std::span<const uint8_t> region, const RunControl& control) {
  return state_->compute(options, region, nullptr, control);
}

Result Scene::compare(const Scene& former, const Options& given, std::span<const uint8_t> region,
                      const RunControl& control) {
  Options options = given;
  options.measure = united(options.measure, Measure::Thickness);
  return compare(former, CheckedOptions(options), region, control);
}

Result Scene::compare(const Scene& former, const CheckedOptions& options, std::span<const uint8_t> region,
                      const RunControl& control) {
  if (!options->measuresThickness()) throw Error(ErrorCode::OptionConflict, "a comparison needs the measure thickness");
  (void)commonUnit(state_->scene->prepared.unit, former.state_->scene->prepared.unit);
  return state_->compute(options, region, &former.state_->judgedSurface(control), control);
}

std::vector<double> Scene::valuesAt(std::span<const double> points, std::span<const double> normals,
                                    const ConeOptions& cone, const RunControl& control) {
  (void)CheckedOptions({.cone = cone});
  requirePoints(points, normals);
  control.checkpoint(0);
  return state_->session.compute(true, control, [&](const RunControl& rest) {
    StageSeconds seconds;
    StageClock clock(seconds, rest.stageBegan);
    const std::shared_ptr<KeptTracer> tracer = state_->tracers().get(cone, {}, clock);
    std::vector<double> values = valuesWith(*tracer, *state_->scene, points, normals, rest);
    (*state_->session.backend)->requireSilentValidation();
    return values;
  });
}

std::vector<double> Scene::thicknessAt(std::span<const double> points, std::span<const double> normals,
                                       const ThicknessOptions& thickness, const RunControl& control) {
  (void)CheckedOptions({.measure = Measure::Thickness, .thickness = thickness});
  requirePoints(points, normals);
  std::vector<Vec3d> unitNormals(normals.size() / 3);
  for (size_t i = 0; i < unitNormals.size(); ++i) unitNormals[i] = unitVector(vectorAt(normals, i));
  return thicknessAtPoints(state_->judgedSurface(control), vectorsOf(points), unitNormals, thickness, control);
}

std::vector<uint32_t> Scene::nearestFaces(std::span<const double> points, const RunControl& control) {
  requirePoints(points);
  std::vector<uint32_t> faces(points.size() / 3);
  state_->takeNearest(points, control, [&](size_t i, const SurfacePoint& found) {
    faces[i] = state_->scene->prepared.mesh.inputFaceOf(found.face);
  });
  return faces;
}

std::vector<double> Scene::distance(std::span<const double> points, const RunControl& control) {
  requirePoints(points);
  std::vector<double> distances(points.size() / 3);
  state_->takeNearest(points, control, [&](size_t i, const SurfacePoint& found) {
    distances[i] = distanceOf(found, state_->scene->bvh.normalization, vectorAt(points, i));
  });
  return distances;
}

std::vector<double> Scene::radii(std::span<const double> points, const RunControl& control) {
  requirePoints(points);
  std::vector<double> radii(points.size() / 3, kNoValue);
  if (points.empty()) return radii;
  state_->requireSurface();
  const PreparedScene& scene = state_->judgedSurface(control).scene();
  findNearestPoints(scene, vectorsOf(points), control, [&](size_t i, const SurfacePoint& found) {
    const Vec3d p = vectorAt(points, i);
    if (found.face == kNoFace) return;
    if (!containsBy(0, scene.prepared.geometry.bounds, {p, p})) return;
    if (found.distance == 0 || isBehindSurface(scene, p, found))
      radii[i] = distanceOf(found, scene.bvh.normalization, p);
  });
  return radii;
}

Scene::RayHits Scene::firstHits(std::span<const double> origins, std::span<const double> directions,
                                const RunControl& control) {
  requirePoints(origins, directions);
  const PreparedScene& scene = *state_->scene;
  std::vector<Vec3d> units = vectorsOf(directions);
  for (Vec3d& direction : units) direction = unitVector(direction);
  const std::vector<RayHit> found = findFirstHits(scene, vectorsOf(origins), units, control);
  RayHits hits{std::vector<double>(found.size(), kNoHit), std::vector<uint32_t>(found.size(), kNoSegment)};
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i].face == kNoFace) continue;
    hits.distances[i] = scene.bvh.normalization.toMeshLength(found[i].distance);
    hits.faces[i] = scene.prepared.mesh.inputFaceOf(found[i].face);
  }
  return hits;
}

}  // namespace asdfvk
