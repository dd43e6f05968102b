#include "cli/computation_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "asdf_vk/error.h"
#include "cli/choice_names.h"
#include "cli/option_adding.h"
#include "cli/option_values.h"

namespace asdfvk {
namespace {

/// "10%", as --seeds takes it.
std::string defaultSeeds() { return fmt::format("{}%", Options{}.seeds.share * 100); }

/// "1%" or "0.01".
double parseShare(const std::string& text) {
  const bool isPercent = text.ends_with('%');
  const double number = parseNumber(isPercent ? text.substr(0, text.size() - 1) : text);
  return isPercent ? number / 100 : number;
}

/// "2s" or "2".
double parseSeconds(const std::string& text) {
  return parseNumber(text.ends_with('s') ? text.substr(0, text.size() - 1) : text);
}

/// "off", "auto" or "2x1": rings x passes.
SmoothingOptions parseSmoothing(const std::string& text) {
  if (text == "off") return {};
  if (text == "auto") return {.isOn = true, .window = {}};
  const size_t cross = text.find('x');
  if (cross == std::string::npos)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not off, auto or RINGSxPASSES such as 2x1", text));
  const BilateralOptions window{static_cast<uint32_t>(parseWholeNumber(text.substr(0, cross), 1, 4)),
                                static_cast<uint32_t>(parseWholeNumber(text.substr(cross + 1), 1, 100))};
  return {.isOn = true, .window = window};
}

void addRecipe(CLI::App& app, CommandLine& line) {
  const auto apply = [&line](const Recipe& recipe) {
    line.recipe = recipe;
    applyRecipe(recipe, line.options);
  };
  addChoice(app, "--recipe", apply, kRecipes,
            "Sets of the options below, which overrule it. paper: random seeds,\n"
            "weights 1/distance, guided by the curvature, as in the ASDF paper.\n"
            "balanced (default): seeds as blue noise, weights by dihedral angle, guided by\n"
            "what the seeds' rays hit; less error than paper on every mesh tried.\n"
            "quality: rays pooled over neighbouring seeds; nearest to a function of\n"
            "endlessly many rays")
      ->group("Seeds and rays");
}

void addSeeds(CLI::App& app, Options& options) {
  const Options defaults;
  const std::string rays = "Seeds and rays";
  addValue(app, "--seeds", "N%|N|all", "Faces that cast rays: a share, a count or all; default " + defaultSeeds(),
           [&](const std::string& text) { options.seeds = parseSeedCount(text); })
      ->group(rays);
  addValue(app, "--rng-seed", "N",
           fmt::format("Seed of the random choice of seed faces; default {}", defaults.randomSeed),
           [&](const std::string& text) {
             options.randomSeed = parseWholeNumber(text, 0, std::numeric_limits<uint64_t>::max());
           })
      ->group(rays);
  const std::vector<std::string> samplers = samplerNames();
  addValue(app, "--sampler", fmt::format("{}", fmt::join(samplers, "|")),
           fmt::format("Selection of the seed faces. adaptive: blue noise in two passes, the second\n"
                       "denser where the predictions of the first are uncertain; default {}",
                       defaults.sampler),
           [&options, samplers](const std::string& text) {
             if (std::find(samplers.begin(), samplers.end(), text) == samplers.end())
               throw Error(ErrorCode::UnknownName,
                           fmt::format("'{}' is not one of {}", text, fmt::join(samplers, "|")));
             options.sampler = text;
           })
      ->group(rays);
  addValue(app, "--max-error", "E%",
           fmt::format("Add seeds in rounds until the estimated average error is below this share\n"
                       "of the range; begins with {}% or --seeds",
                       kFirstRoundShare * 100),
           [&](const std::string& text) {
             options.rounds.maxError = parseShare(text);
             if (!(*options.rounds.maxError > 0 && *options.rounds.maxError < 1))
               throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not above 0% and below 100%", text));
           })
      ->group(rays);
  addValue(app, "--time-budget", "SECONDS", "Add seeds as long as there is time, reading and writing not counted",
           [&](const std::string& text) {
             options.rounds.timeBudgetSeconds = parseSeconds(text);
             if (!(*options.rounds.timeBudgetSeconds > 0))
               throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not a time above 0 s", text));
           })
      ->group(rays);
  app.add_flag_callback(
         "--no-estimate", [&options] { options.estimatesError = false; },
         "Do not estimate the error, which takes about as long as interpolating")
      ->group(rays);
}

void addRays(CLI::App& app, Options& options) {
  const Options defaults;
  const std::string rays = "Seeds and rays";
  addValue(app, "--rays", "N", fmt::format("Rays per cone, 1 to {}; default {}", kMaxRayCount, defaults.cone.rayCount),
           [&](const std::string& text) {
             options.cone.rayCount = static_cast<uint32_t>(parseWholeNumber(text, 1, kMaxRayCount));
           })
      ->group(rays);
  addValue(app, "--angle", "DEGREES",
           fmt::format("Full opening angle of the cone, above 0 and below 180; default {}",
                       defaults.cone.openingAngleDegrees),
           [&](const std::string& text) {
             options.cone.openingAngleDegrees = parseNumber(
                 text, [](double x) { return x > 0 && x < 180; }, "is not above 0 and below 180");
           })
      ->group(rays);
  addValue(app, "--false-hit-angle", "DEGREES",
           fmt::format("A hit on a face whose normal is within this angle of the seed's is\n"
                       "false, 0 to 180; default {}",
                       defaults.cone.falseHitAngleDegrees),
           [&](const std::string& text) {
             options.cone.falseHitAngleDegrees = parseNumber(
                 text, [](double x) { return x >= 0 && x <= 180; }, "is not from 0 to 180");
           })
      ->group(rays);
  addValue(app, "--outlier-deviations", "S",
           fmt::format("Lengths farther from the median than S standard deviations are left\n"
                       "out, above 0; default {}",
                       defaults.cone.outlierDeviations),
           [&](const std::string& text) {
             options.cone.outlierDeviations = parseNumber(
                 text, [](double x) { return x > 0; }, "is not above 0");
           })
      ->group(rays);
  addChoice(app, "--orient", options.orientation, kOrientations,
            "Closed components that look the wrong way: name them, turn them, or\n"
            "turn every face; default keep")
      ->group(rays);
  addValue(app, "--smooth", "off|auto|RxP",
           "Smooth the values bilaterally over R rings of faces, P times; auto: by the\n"
           "number of faces. For --seeds all with --cone-rotation hashed; default off",
           [&](const std::string& text) { options.smoothing = parseSmoothing(text); })
      ->group(rays);
  addChoice(app, "--cone-rotation", options.cone.rotation, kConeRotations,
            "Rays lie alike in the cones of neighbouring faces, or turned by a hash of the\n"
            "face, so that neighbours err independently; default fixed")
      ->group(rays);
}

void addInterpolation(CLI::App& app, Options& options) {
  const Options defaults;
  const std::string interpolation = "Interpolation";
  addChoice(app, "--weights", options.interpolation.weights, kWeights,
            "Weight of two neighbouring faces: 1/distance, or lower the sharper the edge\n"
            "between them, more so on concave edges; default feature")
      ->group(interpolation);
  addChoice(app, "--guidance", options.interpolation.guidance, kGuidances,
            "Where the guidance field comes from: none (harmonic), minus the curvature,\n"
            "or what the hits of the seeds' rays predict for the others; default hits")
      ->group(interpolation);
  addValue(app, "--pooling", "P",
           fmt::format("How far values are moved to what the hits of several seeds predict, 0\n"
                       "(traced values are kept) to 1; default {}",
                       defaults.interpolation.pooling),
           [&](const std::string& text) {
             options.interpolation.pooling = parseNumber(
                 text, [](double x) { return x >= 0 && x <= 1; }, "is not from 0 to 1");
           })
      ->group(interpolation);
  addChoice(app, "--solver", options.solver, kSolvers,
            "Conjugate gradient or Jacobi on the device, or conjugate gradient on the CPU, in\n"
            "float32 (cpu) or with Eigen; default auto")
      ->group(interpolation);
  addValue(app, "--tolerance", "R",
           fmt::format("Relative residual at which the solver stops, above 0 and below 1;\n"
                       "default {}",
                       defaults.solverOptions.tolerance),
           [&](const std::string& text) {
             options.solverOptions.tolerance = parseNumber(
                 text, [](double x) { return x > 0 && x < 1; }, "is not above 0 and below 1");
           })
      ->group(interpolation);
  addValue(app, "--max-iterations", "N",
           fmt::format("Iterations after which the solver gives up; default {}", defaults.solverOptions.maxIterations),
           [&](const std::string& text) {
             options.solverOptions.maxIterations =
                 static_cast<uint32_t>(parseWholeNumber(text, 1, std::numeric_limits<uint32_t>::max()));
           })
      ->group(interpolation);
}

}  // namespace

void addComputation(CLI::App& app, CommandLine& line) {
  addRecipe(app, line);  // First: its callback comes before the others'.
  addSeeds(app, line.options);
  addRays(app, line.options);
  addInterpolation(app, line.options);
}

}  // namespace asdfvk
