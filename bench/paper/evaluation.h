#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/choice_names.h"
#include "pipeline/asdf.h"

namespace asdfvk::bench {

/// The shares of Table 1 and all faces, in percent.
inline constexpr std::array<double, 7> kPercents{100, 50, 20, 10, 5, 2, 1};
inline constexpr size_t kRecipeCount = kRecipes.size();

struct EvaluationOptions {
  uint32_t seedSetCount = 3;     ///< Every figure is the median over so many random seeds.
  uint32_t truthRayCount = 600;  ///< Of the function that is called the truth, its cones turned by a hash.
};

/// A recipe at one share. Errors are over the range of the full function, which is the one of 30 rays at every face
/// with cones all alike; all faces are counted, as in the paper's Table 1.
struct ShareResult {
  double percent = 0;
  uint64_t seedCount = 0;
  double average = 0, maximum = 0;            ///< Against the full function.
  double truthAverage = 0, truthMaximum = 0;  ///< Against the truth.
  double estimated = kNoValue;                ///< What the result itself tells of `average`; NaN where it does not.
  double sampleSeconds = 0, traceSeconds = 0, predictSeconds = 0, solveSeconds = 0;
  double timeRatio = 0;  ///< seconds() over the trace of the full function in the same round.

  [[nodiscard]] double seconds() const { return sampleSeconds + traceSeconds + predictSeconds + solveSeconds; }
};

struct Evaluation {
  std::string name;
  Result full;  ///< Of 30 rays at every face, the paper's reference.
  double fullTraceSeconds = 0;
  std::array<std::array<ShareResult, kPercents.size()>, kRecipeCount> recipes;  ///< In the order of kRecipes.

  [[nodiscard]] double range() const { return full.report.sdf.max - full.report.sdf.min; }
  [[nodiscard]] const ShareResult& at(Recipe recipe, double percent) const;
  /// The full function against the truth: the noise floor.
  [[nodiscard]] const ShareResult& floor() const { return at(Recipe::Paper, 100); }
};

/// Options of a recipe at a share of the faces.
[[nodiscard]] Options recipeOptions(Recipe recipe, double percent, uint64_t randomSeed);

/// Throws Error{Input} for a mesh whose values do not differ: there is no range to divide by. What is being done goes
/// to standard error, a line at a time.
[[nodiscard]] Evaluation evaluate(Session& session, const std::string& name, Mesh& mesh,
                                  const EvaluationOptions& options, const RunControl& control);

}  // namespace asdfvk::bench
