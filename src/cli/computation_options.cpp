// The options of the computation.
#include <fmt/core.h>

#include <limits>
#include <string_view>

#include "asdf_vk/error.h"
#include "cli/option_parsing.h"

namespace asdfvk {
namespace {

constexpr const char* kRayGroup = "Seeds and rays";

std::string seedHelp() {
  return fmt::format(
      "Faces that cast rays: a share, a count or all; default auto: {}% but at least\n"
      "{} (without this minimum if the guidance is not by prediction)",
      kAutomaticSeedShare * 100, kMinAutomaticSeedCount);
}

/// "1%" or "0.01".
double parseShare(const std::string& text) {
  const bool isPercent = text.ends_with('%');
  const double number = parseNumber(isPercent ? text.substr(0, text.size() - 1) : text);
  return isPercent ? number / 100 : number;
}

/// "1%" (of the range) or "5%rel" (of the value).
void parseMaxError(const std::string& text, RoundOptions& rounds) {
  constexpr std::string_view kRelative = "rel";
  const bool isRelative = text.ends_with(kRelative);
  const auto share = [&] {
    try {
      return parseShare(isRelative ? text.substr(0, text.size() - kRelative.size()) : text);
    } catch (const Error&) {
      throw Error(ErrorCode::OptionOutOfRange,
                  fmt::format("'{}' is not an error such as 1% (of the range) or 5%rel (of the value)", text));
    }
  }();
  if (!(share > 0 && share < 1))
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not above 0% and below 100%", text));
  (isRelative ? rounds.maxRelativeError : rounds.maxError) = share;
}

/// "off", "auto" or "2x1": rings x passes.
SmoothingOptions parseSmoothing(const std::string& text) {
  if (text == "off") return {};
  if (text == "auto") return {.isOn = true, .window = {}};
  const size_t cross = text.find('x');
  if (cross == std::string::npos)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not off, auto or RINGSxPASSES such as 2x1", text));
  const SmoothingOptions::Window window{static_cast<uint32_t>(parseWholeNumber(text.substr(0, cross), 1, 4)),
                                        static_cast<uint32_t>(parseWholeNumber(text.substr(cross + 1), 1, 100))};
  return {.isOn = true, .window = window};
}

void addBasics(ArgumentParser& parser, CommandLine& line) {
  Options& options = line.computation.options;
  const auto apply = [&line](const Recipe& recipe) {
    line.computation.recipe = recipe;
    applyRecipe(recipe, line.computation.options);
  };
  // First the recipe and the definition: their callbacks must run before those of the options that they set.
  addChoice(parser, "--recipe", apply, kRecipes,
            "Set of options; single options override it. paper: as the ASDF paper.\n"
            "balanced (default): half of the error of paper. quality: rays pooled over\n"
            "neighbouring seeds, least error against many rays")
      .group(kBasicGroup);
  addChoice(
      parser, "--definition", [&options](const Definition& definition) { applyDefinition(definition, options); },
      kDefinitions,
      "Definition of the values: of the ASDF paper, or of CGAL's sdf_values without\n"
      "post-processing. cgal: --rays 25 --seeds all unless given; default paper")
      .group(kRayGroup);
  addValue(parser, "--seeds", "N%|N|all|auto", seedHelp(), [&](const std::string& text) {
    options.seeds = parseSeedCount(text);
  }).group(kBasicGroup);
  addValue(parser, "--max-error", "E%[rel]",
           fmt::format("Add seeds until the estimated average error is below this share of the\n"
                       "range, or with rel until the median of error / value is; starts with {}%\n"
                       "or --seeds",
                       kFirstRoundShare * 100),
           [&](const std::string& text) { parseMaxError(text, options.rounds); })
      .group(kBasicGroup);
  addChoice(parser, "--orient", options.orientation, kOrientations,
            "Inverted closed components: report them, reverse them, or reverse\n"
            "all faces; default keep")
      .group(kBasicGroup);
}

void addSeeds(ArgumentParser& parser, Options& options) {
  const Options defaults;
  const char* const group = kRayGroup;
  addName(parser, "--sampler", options.sampler, samplerNames(),
          fmt::format("Selection of the seed faces. adaptive: blue noise in two passes, the second\n"
                      "denser where the first predicts errors; default {}",
                      defaults.sampler))
      .group(group);
  addValue(parser, "--rng-seed", "N", fmt::format("Random seed; default {}", defaults.randomSeed),
           [&](const std::string& text) {
             options.randomSeed = parseWholeNumber(text, 0, std::numeric_limits<uint64_t>::max());
           })
      .group(group);
  addValue(parser, "--time-budget", "SECONDS",
           "Add seeds until this time has passed, reading and writing excluded. The\n"
           "result is not reproducible",
           [&](const std::string& text) { options.rounds.timeBudgetSeconds = parseSeconds(text); })
      .group(group);
  parser
      .addFlag(
          "--no-estimate", [&options] { options.estimatesError = false; },
          "Do not estimate the error; saves about 5 % of the time")
      .group(group);
}

void addRays(ArgumentParser& parser, Options& options) {
  const Options defaults;
  const char* const group = kRayGroup;
  addValue(parser, "--rays", "N",
           fmt::format("Rays per cone, 1 to {}; default {}", kMaxRayCount, defaults.cone.rayCount),
           [&](const std::string& text) {
             options.cone.rayCount = static_cast<uint32_t>(parseWholeNumber(text, 1, kMaxRayCount));
           })
      .group(group);
  addValue(parser, "--angle", "DEGREES",
           fmt::format("Full opening angle of the cone, above 0 and below 180; default {}",
                       defaults.cone.openingAngleDegrees),
           [&](const std::string& text) {
             options.cone.openingAngleDegrees = parseNumber(
                 text, [](double x) { return x > 0 && x < 180; }, "is not above 0 and below 180");
           })
      .group(group);
  addValue(parser, "--false-hit-angle", "DEGREES",
           fmt::format("Of paper: a hit is false where the normals of the hit face and of the seed\n"
                       "differ by less than this, 0 to 180; default {}",
                       defaults.cone.falseHitAngleDegrees),
           [&](const std::string& text) {
             options.cone.falseHitAngleDegrees = parseNumber(
                 text, [](double x) { return x >= 0 && x <= 180; }, "is not from 0 to 180");
           })
      .group(group);
  addValue(parser, "--outlier-deviations", "S",
           fmt::format("Of paper: lengths farther from the median than S standard deviations are\n"
                       "dropped, above 0; default {}",
                       defaults.cone.outlierDeviations),
           [&](const std::string& text) {
             options.cone.outlierDeviations = parseNumber(
                 text, [](double x) { return x > 0; }, "is not above 0");
           })
      .group(group);
  addChoice(parser, "--cone-rotation", options.cone.rotation, kConeRotations,
            "Of paper: rotation of the cones: fixed (parallel rays in neighbouring cones) or\n"
            "hashed (by face index, so that errors are independent); default fixed")
      .group(group);
  addValue(parser, "--smooth", "off|auto|RxP",
           "Bilateral filter over R rings of faces, P passes; auto: by the number of\n"
           "faces. For --seeds all with --cone-rotation hashed; default off",
           [&](const std::string& text) { options.smoothing = parseSmoothing(text); })
      .group(group);
}

void addExperiments(ArgumentParser& parser, Options& options) {
  const Options defaults;
  addChoice(parser, "--weights", options.interpolation.weights, kWeights,
            "Edge weights of the dual graph: 1/distance of the barycentres, or by the\n"
            "dihedral angle; default feature")
      .group(kExperimentGroup);
  addChoice(parser, "--guidance", options.interpolation.guidance, kGuidances,
            "Guidance field: none (harmonic), minus the curvature, or the gradient of\n"
            "values predicted from the hits of neighbouring seeds; default prediction")
      .group(kExperimentGroup);
  addValue(parser, "--pooling", "P",
           fmt::format("Weight of the prediction in the values, 0 (traced values are kept) to\n"
                       "1; default {}",
                       defaults.interpolation.pooling),
           [&](const std::string& text) {
             options.interpolation.pooling = parseNumber(
                 text, [](double x) { return x >= 0 && x <= 1; }, "is not from 0 to 1");
           })
      .group(kExperimentGroup);
  addName(parser, "--solver", options.solver, solverNames(),
          "Conjugate gradients (cg) or Jacobi on the device, conjugate gradients on the\n"
          "CPU in float32 (cpu) or with Eigen in double; default auto")
      .group(kExperimentGroup);
  addValue(parser, "--tolerance", "R",
           fmt::format("Relative residual at which the solver stops, above 0 and below 1;\n"
                       "default {}",
                       defaults.solverOptions.tolerance),
           [&](const std::string& text) {
             options.solverOptions.tolerance = parseNumber(
                 text, [](double x) { return x > 0 && x < 1; }, "is not above 0 and below 1");
           })
      .group(kExperimentGroup);
  addValue(parser, "--max-iterations", "N",
           fmt::format("Iterations at which the solver stops; default {}", defaults.solverOptions.maxIterations),
           [&](const std::string& text) {
             options.solverOptions.maxIterations =
                 static_cast<uint32_t>(parseWholeNumber(text, 1, std::numeric_limits<uint32_t>::max()));
           })
      .group(kExperimentGroup);
}

}  // namespace

void addComputation(ArgumentParser& parser, CommandLine& line) {
  addBasics(parser, line);
  addSeeds(parser, line.computation.options);
  addRays(parser, line.computation.options);
  addSegments(parser, line.computation.options);
  addMeasure(parser, line);
  addExperiments(parser, line.computation.options);
}

}  // namespace asdfvk
