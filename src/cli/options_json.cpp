// The values of the options in the JSON report.
#include <fmt/core.h>

#include <utility>

#include "asdf_vk/choices.h"
#include "cli/option_parsing.h"
#include "core/json.h"

namespace asdfvk {
namespace {

/// Keys in the order of add(). A list of initializers for all keys would take seconds to compile.
class Values {
 public:
  [[gnu::noinline]] void add(const char* key, Json value) { json_[key] = std::move(value); }
  template <typename T>
  void add(const char* key, const std::optional<T>& value) {
    add(key, value ? Json(*value) : Json(nullptr));
  }
  [[nodiscard]] Json take() { return std::move(json_); }

 private:
  Json json_ = Json::object();
};

std::string toText(const SmoothingOptions& smoothing) {
  if (!smoothing.isOn) return "off";
  if (!smoothing.window) return "auto";
  return fmt::format("{}x{}", smoothing.window->rings, smoothing.window->passes);
}

std::string nameOrAuto(const std::string& name) { return name.empty() ? "auto" : name; }

void addComputation(Values& values, const Options& options) {
  const ConeOptions& cone = options.cone;
  // The options of the paper's definition are null with another definition.
  const bool isPaper = cone.definition == Definition::Paper;
  const auto ofPaper = [&](Json value) { return isPaper ? std::move(value) : Json(nullptr); };
  values.add("seeds", toText(options.seeds));
  values.add("sampler", options.sampler);
  values.add("maxError", options.rounds.maxError);
  values.add("maxRelativeError", options.rounds.maxRelativeError);
  values.add("timeBudgetSeconds", options.rounds.timeBudgetSeconds);
  values.add("rays", cone.rayCount);
  values.add("angleDegrees", cone.openingAngleDegrees);
  values.add("falseHitAngleDegrees", ofPaper(cone.falseHitAngleDegrees));
  values.add("outlierDeviations", ofPaper(cone.outlierDeviations));
  values.add("coneRotation", ofPaper(nameOf(kConeRotations, cone.rotation)));
  values.add("smooth", toText(options.smoothing));
  values.add("orient", nameOf(kOrientations, options.orientation));
  values.add("per", nameOf(kPerElements, options.per));
  values.add("weights", nameOf(kWeights, options.interpolation.weights));
  values.add("guidance", nameOf(kGuidances, options.interpolation.guidance));
  values.add("pooling", options.interpolation.pooling);
  values.add("solver", options.solver);
  values.add("tolerance", options.solverOptions.tolerance);
  values.add("maxIterations", options.solverOptions.maxIterations);
}

void addSession(Values& values, const SessionOptions& session) {
  values.add("backend", session.backend);
  values.add("device", session.device);
  values.add("requireGpu", session.requireGpu);
  values.add("kernel", nameOrAuto(session.variant.kernel));
  values.add("bvh", nameOrAuto(session.variant.bvh));
  values.add("fetch", nameOrAuto(session.variant.fetch));
}

void addSegments(Values& values, const Options& options) {
  values.add("postprocess", nameOf(kPostprocesses, options.postprocess));
  values.add("segment", nameOf(kSegmentations, options.segmentation));
  values.add("parts", options.parts.partCount);
  values.add("detail", options.parts.detail);
  values.add("clusters", options.cgalSegmentation.clusterCount);
  values.add("smoothness", options.cgalSegmentation.smoothness);
  values.add("cgalExpansion", nameOf(kCgalExpansions, options.cgalSegmentation.expansion));
}

void addMeasure(Values& values, const Computation& computation) {
  const ThicknessOptions& thickness = computation.options.thickness;
  const bool isMeasured = computation.options.measuresThickness();
  values.add("measure", nameOf(kMeasures, computation.options.measure));
  values.add("wallAngleDegrees", isMeasured ? Json(thickness.wallAngleDegrees) : Json(nullptr));
  values.add("thinnerThan", thickness.thinnerThan);
  values.add("failIfThinner", computation.failIfThinner);
  values.add("allowSharpEdges", thickness.allowsSharpEdges);
}

}  // namespace

Json optionValues(const Computation& computation, const SessionOptions& session) {
  Values values;
  values.add("recipe", nameOf(kRecipes, computation.recipe));
  values.add("definition", nameOf(kDefinitions, computation.options.cone.definition));
  addComputation(values, computation.options);
  addSession(values, session);
  addSegments(values, computation.options);
  addMeasure(values, computation);
  return values.take();
}

}  // namespace asdfvk
