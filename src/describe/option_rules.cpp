#include "describe/option_rules.h"

#include <fmt/core.h>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

constexpr uint32_t kCgalRayCount = 25;  // The default of CGAL's sdf_values().

[[noreturn]] void refuseOption(std::string_view message, OptionSpelling spelling) {
  ComputationSettings defaults;
  refuse(computationRows(defaults), message, spelling);
}

/// A limit implies the measure that it limits: names are "thinner-than" and "fail-if-thinner".
void applyLimit(std::optional<LengthLimit>& limit, const std::optional<LengthLimit>& failIf, std::string_view reports,
                std::string_view fails, Measure measure, std::optional<Measure>& implied, const GivenOptions& given) {
  if (failIf) {
    if (limit && *limit != *failIf)
      refuseOption(fmt::format("{{{}}} and {{{}}} have different limits; give one of them", reports, fails),
                   given.spelling);
    limit = failIf;
  }
  if (!limit) return;
  implied = implied ? united(*implied, measure) : measure;
}

/// Without the option "measure", only what the limits need is measured.
void applyLimits(ComputationSettings& computation, const GivenOptions& given) {
  Options& options = computation.options;
  ThicknessOptions& limits = options.thickness;
  std::optional<Measure> implied;
  applyLimit(limits.thinnerThan, computation.failIfThinner, "thinner-than", "fail-if-thinner", Measure::Thickness,
             implied, given);
  applyLimit(limits.thickerThan, computation.failIfThicker, "thicker-than", "fail-if-thicker", Measure::Thickness,
             implied, given);
  applyLimit(limits.closerThan, computation.failIfCloser, "closer-than", "fail-if-closer", Measure::Gap, implied,
             given);
  if (computation.compares) implied = implied ? united(*implied, Measure::Thickness) : Measure::Thickness;
  if (computation.failsIfVoids || computation.failsIfContact)
    implied = implied ? united(*implied, Measure::Gap) : Measure::Gap;
  if (!implied) return;
  if (given.has("measure") && options.measure == Measure::ShapeDiameter && computation.compares)
    refuseOption("a comparison needs {measure=thickness}, or both", given.spelling);
  if (given.has("measure") && options.measure == Measure::ShapeDiameter)
    refuseOption(fmt::format("{{{}}} contradicts {{measure=sdf}}; drop one of the two",
                             limits.thinnerThan         ? "thinner-than"
                             : limits.thickerThan       ? "thicker-than"
                             : limits.closerThan        ? "closer-than"
                             : computation.compares     ? "compare"
                             : computation.failsIfVoids ? "fail-if-voids"
                                                        : "fail-if-contact"),
                 given.spelling);
  options.measure =
      given.has("measure") || options.measure != Measure::ShapeDiameter ? united(options.measure, *implied) : *implied;
}

void applySegmentation(Options& options, const GivenOptions& given) {
  if (options.segmentation == Segmentation::Cgal && given.has("postprocess") &&
      options.postprocess == Postprocess::None)
    refuseOption("{segment=cgal} contradicts {postprocess=none}; drop one of the two", given.spelling);
  if (options.postprocesses()) options.postprocess = Postprocess::Cgal;
}

void refuseContradictions(const Options& options, const GivenOptions& given) {
  const RoundOptions& rounds = options.rounds;
  const bool isRelative = !rounds.maxError && given.spelling != OptionSpelling::Flag;  // --max-error 5%rel
  const std::string maxError = isRelative ? "{max-relative-error}" : "{max-error}";
  if (rounds.areSet() && !options.estimatesError)
    refuseOption(maxError + " needs the error estimate, which {estimate=off} excludes; drop one of the two",
                 given.spelling);
  if (rounds.areSet() && options.seeds.kind == SeedCount::Kind::All)
    refuseOption(maxError + " adds seeds, but with {seeds=all} every face is a seed; drop one of the two",
                 given.spelling);
  if (options.interpolation.pooling > 0 && options.interpolation.guidance != Guidance::Prediction)
    refuseOption(
        "{pooling} needs a prediction, which {recipe=paper} and {guidance=none} or curvature exclude; drop one of them",
        given.spelling);
  if (options.parts.partCount && (given.has("detail") || options.parts.detail != 1))
    refuseOption("{parts} and {detail} contradict each other; drop one", given.spelling);
  if (options.cone.definition != Definition::Paper && options.cone.rotation != ConeRotation::Fixed)
    refuseOption("{recipe=quality} rotates the cones, which needs {definition=paper}; use another recipe",
                 given.spelling);
}

}  // namespace

void applyRecipe(Recipe recipe, Options& options) {
  const Options balanced;
  options.cone.rotation = balanced.cone.rotation;
  options.sampler = balanced.sampler;
  options.interpolation = balanced.interpolation;
  switch (recipe) {
    case Recipe::Paper:
      options.sampler = SamplerChoice::Random;
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
  options.seeds.isChosen = false;
}

void complete(ComputationSettings& computation, const GivenOptions& given) {
  Options& options = computation.options;
  applyLimits(computation, given);
  applySegmentation(options, given);
  if (options.rounds.areSet() && !options.seeds.isChosen) options.seeds = SeedCount::ofShare(kFirstRoundShare);
  ComputationSettings copy = computation;
  requireInRange(computationRows(copy), given.spelling);
  requireNeeds(computationRows(computation), given);
  refuseContradictions(options, given);
}

CheckedOptions::CheckedOptions(const Options& options) {
  ComputationSettings computation, defaults;
  computation.options = options;
  const OptionRows rows = computationRows(computation), defaultRows = computationRows(defaults);
  GivenOptions given;
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i].member.write() != defaultRows[i].member.write()) given.names.insert(rows[i].name);
  complete(computation, given);
  options_ = computation.options;
}

}  // namespace asdfvk
