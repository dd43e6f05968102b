#include "asdf_vk/options.h"

#include <fmt/core.h>

#include <cmath>

#include "asdf_vk/error.h"
#include "cone/opposing_walls.h"
#include "pipeline/seed_choice.h"
#include "pipeline/valid_options.h"
#include "poisson/poisson_solver.h"
#include "seeds/samplers.h"
#include "smooth/bilateral.h"

namespace asdfvk {
namespace {

constexpr uint32_t kCgalRayCount = 25;  // The default of CGAL's sdf_values().

[[noreturn]] void fail(const std::string& reason) { throw Error(ErrorCode::OptionOutOfRange, reason); }

}  // namespace

void applyRecipe(Recipe recipe, Options& options) {
  const Options balanced;
  options.cone.rotation = balanced.cone.rotation;
  options.sampler = balanced.sampler;
  options.interpolation = balanced.interpolation;
  switch (recipe) {
    case Recipe::Paper:
      options.sampler = "random";
      options.interpolation.weights = ArcWeights::Distance;
      options.interpolation.guidance = Guidance::Curvature;
      break;
    case Recipe::Balanced:
      break;
    case Recipe::Quality:
      options.cone.rotation = ConeRotation::Hashed;
      options.interpolation.pooling = 0.75;
      break;
  }
}

void applyDefinition(Definition definition, Options& options) {
  const Options paper;
  options.cone.definition = definition;
  options.cone.rayCount = definition == Definition::Cgal ? kCgalRayCount : paper.cone.rayCount;
  options.seeds = definition == Definition::Cgal ? SeedCount::all() : paper.seeds;
}

std::vector<std::string> solverNames() {
  std::vector<std::string> names{kAutomaticSolver};
  for (const Solver& solver : solverTable()) names.emplace_back(solver.name);
  return names;
}

bool solverNeedsDevice(const std::string& name) { return name != kAutomaticSolver && findSolver(name).needsDevice; }

std::vector<std::string> samplerNames() {
  std::vector<std::string> names;
  for (const Sampler& sampler : kSamplers) names.emplace_back(sampler.name);
  return names;
}

void requireValid(const CgalSegmentationOptions& options) {
  if (options.clusterCount < 2 || options.clusterCount > kMaxClusterCount)
    fail(fmt::format("{} clusters are out of range (2 to {})", options.clusterCount, kMaxClusterCount));
  if (!(options.smoothness >= 0 && options.smoothness <= kMaxSmoothness))
    fail(fmt::format("a smoothness of {} is out of range (0 to {})", options.smoothness, kMaxSmoothness));
}

void requireValid(const Options& options, bool hasDevice) {
  const InterpolationOptions& interpolation = options.interpolation;
  if (!(interpolation.pooling >= 0 && interpolation.pooling <= 1))
    fail(fmt::format("a pooling of {} is out of range (0 to 1)", interpolation.pooling));
  if (interpolation.pooling > 0 && interpolation.guidance != Guidance::Prediction)
    throw Error(ErrorCode::OptionConflict, "pooling needs the prediction; choose guidance by prediction");
  (void)samplerOf(options);
  (void)resolveSeedCount(options, 1);
  if (options.solver != kAutomaticSolver) requireUsable(findSolver(options.solver), hasDevice);
  if (const double tolerance = options.solverOptions.tolerance; !(tolerance > 0 && tolerance < 1))
    fail(fmt::format("a tolerance of {} is out of range (above 0, below 1)", tolerance));
  if (options.solverOptions.maxIterations == 0) fail("0 iterations are out of range; give 1 or more");
  if (options.checkCount == 0) fail("a check of 0 faces is out of range; give 1 or more");
  if (options.smoothing.window) requireValid(*options.smoothing.window);
  if (options.segmentation == Segmentation::Cgal) requireValid(options.cgalSegmentation);
  if (options.measuresThickness()) (void)makeOpposingWalls(options.thickness.wallAngleDegrees);
  if (const std::optional<double>& limit = options.thickness.thinnerThan; limit) {
    if (!(*limit > 0 && std::isfinite(*limit)))
      fail(fmt::format("a thickness limit of {} is out of range; give more than 0", *limit));
    if (!options.measuresThickness())
      throw Error(ErrorCode::OptionConflict, "a thickness limit needs the measure thickness");
  }
  if (options.thickness.allowsSharpEdges && !options.thickness.thinnerThan)
    throw Error(ErrorCode::OptionConflict, "sharp edges are allowed below a thickness limit only; give a limit");
  if (const PartsOptions& parts = options.parts; options.segmentation == Segmentation::Parts) {
    if (parts.partCount && (*parts.partCount < 1 || *parts.partCount > kMaxPartCount))
      fail(fmt::format("{} parts are out of range (1 to {})", *parts.partCount, kMaxPartCount));
    if (!(parts.detail >= kMinDetail && parts.detail <= kMaxDetail))
      fail(fmt::format("a detail of {} is out of range ({} to {})", parts.detail, kMinDetail, kMaxDetail));
    if (parts.partCount && parts.detail != 1)
      throw Error(ErrorCode::OptionConflict, "a number of parts and a detail contradict each other");
  }
  for (const std::optional<double>& maxError : {options.rounds.maxError, options.rounds.maxRelativeError})
    if (maxError && !(*maxError > 0 && *maxError < 1))
      fail(fmt::format("a maximum error of {} is out of range (above 0, below 1)", *maxError));
  if (options.rounds.limitError() && !options.estimatesError)
    throw Error(ErrorCode::OptionConflict, "a maximum error needs the error estimate; drop one of the two");
  if (options.rounds.areSet() && options.seeds.kind == SeedCount::Kind::All)
    throw Error(
        ErrorCode::OptionConflict,
        "a maximum error or time budget adds seeds, but all faces are seeds; choose a share or number of seeds");
  if (options.rounds.timeBudgetSeconds && !(*options.rounds.timeBudgetSeconds > 0))
    fail(fmt::format("a time budget of {} s is out of range; give more than 0", *options.rounds.timeBudgetSeconds));
}

}  // namespace asdfvk
