#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "asdf_vk/choices.h"
#include "asdf_vk/session.h"
#include "render/camera.h"
#include "trace/scene_data.h"

namespace asdfvk::bench {

/// All faces, and the shares of Table 1 of the ASDF paper, in percent.
inline constexpr std::array<double, 7> kPercents{100, 50, 20, 10, 5, 2, 1};

struct NamedMesh {
  std::string name;  ///< Unique. Only letters, digits, "-", "_" and ".", because file names contain the name.
  Mesh mesh;
  View view = {};                               ///< Direction of the view in pictures.
  std::shared_ptr<const SceneData> scene = {};  ///< Scene for the pictures; set by evaluate().
};

/// Reads the meshes. The name of a mesh is made from the name of its file. Throws Error{Input}.
[[nodiscard]] std::vector<NamedMesh> readMeshes(const std::vector<std::string>& paths);

[[nodiscard]] std::vector<NamedMesh> generateMeshes(uint64_t faceCount);

struct EvaluationOptions {
  /// Number of random seed sets. Unless a comment states otherwise, figures are medians over the sets.
  uint32_t seedSetCount = 3;
  uint32_t truthRayCount = 600;  ///< Rays per face for the truth (see evaluate()).
};

/// Results of a recipe with one share of seeds. Errors are errors of all faces, divided by the range of the full
/// function.
struct ShareResult {
  double percent = 0;
  uint64_t seedCount = 0;
  double averageError = 0, maximumError = 0;               ///< Differences from the full function.
  double leastAverageError = 0, greatestAverageError = 0;  ///< Least and greatest averageError over the seed sets.
  double truthAverageError = 0, truthMaximumError = 0;     ///< Differences from the truth.
  double estimatedError = kNoValue;  ///< Estimate of averageError in the report; NaN without an estimate.
  double sampleSeconds = 0, traceSeconds = 0, predictSeconds = 0, solveSeconds = 0;
  double timeRatio = 0;  ///< Sum of the four times above, divided by the time of the full trace in the same round.
};

struct Evaluation {
  std::string name;
  Result full;  ///< The full function: values from 30 rays at every face with fixed cones, as in the paper.
  double fullTraceSeconds = 0;
  std::array<std::array<ShareResult, kPercents.size()>, kRecipes.size()> recipes;  ///< In the order of kRecipes.

  [[nodiscard]] double range() const { return full.report.sdf.max - full.report.sdf.min; }
};

/// Compares all recipes at all shares with the full function and with the truth. The truth is the values from
/// truthRayCount rays at every face, with hashed cones. Throws for a mesh whose values are all equal. Reports progress
/// on standard error.
[[nodiscard]] Evaluation evaluate(Session& session, NamedMesh& mesh, const EvaluationOptions& options,
                                  const RunControl& control);

}  // namespace asdfvk::bench
