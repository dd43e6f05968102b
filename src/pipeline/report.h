#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "estimate/error_estimate.h"
#include "mesh/mesh.h"
#include "mesh/validation.h"
#include "poisson/poisson_solver.h"
#include "trace/vulkan/vulkan_trace_choice.h"

/// What a computation tells about itself beside its values.
namespace asdfvk {

/// Seconds of wall clock, none of them counted twice. A stage that did not run is 0.
struct StageSeconds {
  double read = 0;
  double geometry = 0;  ///< Normals, areas, components, defects and orientation.
  double graph = 0;     ///< The dual graph, and what its edges tell about the mesh.
  double bvh = 0;       ///< The hierarchy.
  double encode = 0;    ///< The layout that is traced, or Embree's scene, a second one where the first will not do.
  double upload = 0;    ///< To the device: kernels and buffers, and their release; 0 without Vulkan.
  double sample = 0;    ///< Choosing the seeds.
  double trace = 0;     ///< Casting their rays.
  double predict = 0;   ///< Reprojecting their hits.
  double solve = 0;     ///< The Poisson equation.
  double estimate = 0, smooth = 0, write = 0;
};

/// The stages in the order in which they run, by the names under which they are reported.
inline constexpr std::array<std::pair<const char*, double StageSeconds::*>, 13> kStages{{
    {"read", &StageSeconds::read},
    {"geometry", &StageSeconds::geometry},
    {"graph", &StageSeconds::graph},
    {"bvh", &StageSeconds::bvh},
    {"encode", &StageSeconds::encode},
    {"upload", &StageSeconds::upload},
    {"sample", &StageSeconds::sample},
    {"trace", &StageSeconds::trace},
    {"predict", &StageSeconds::predict},
    {"solve", &StageSeconds::solve},
    {"estimate", &StageSeconds::estimate},
    {"smooth", &StageSeconds::smooth},
    {"write", &StageSeconds::write},
}};

/// What the double-precision reference says about the result. Two random choices of faces are recomputed: traced ones,
/// to see whether the device computes what it should, and ones among all that can cast rays, to see how far off the
/// interpolation is.
struct CheckReport {
  /// False when the reference itself traced: then its values would be compared with themselves, so no traced face is
  /// checked and only the errors below tell something.
  bool isIndependent = true;
  uint64_t tracedCount = 0;        ///< Traced faces that were recomputed.
  uint64_t agreeingCount = 0;      ///< Of those, within kAgreementTolerance of the box's diagonal.
  uint64_t noValueAgreeCount = 0;  ///< Of those, without a value on either side: agreeing, but nothing was compared.
  double medianDifference = 0;     ///< Over the diagonal, traced faces with a value on some side.
  double worstDifference = 0;      ///< Likewise; infinite if only one side has a value.
  uint64_t worstFace = 0;          ///< Its input face.

  uint64_t comparedCount = 0;           ///< Faces of the choice among all, seeds included, with a value on both sides.
  double averageError = 0;              ///< Of those, over the range of their reference values: Table 1 of the paper.
  double maximumError = 0;              ///< Likewise.
  uint64_t interpolatedCount = 0;       ///< Those of the compared faces that were interpolated.
  double interpolatedAverageError = 0;  ///< Of those, over the same range.
  double interpolatedMaximumError = 0;  ///< Likewise.

  /// Some traced face agrees, and the others do but for kAllowedMissShare of them. One miss is always allowed: a ray
  /// that grazes an edge may fall to either side, and must not fail a check of few faces.
  bool passed = false;

  [[nodiscard]] uint64_t missCount() const { return tracedCount - agreeingCount - noValueAgreeCount; }
};
inline constexpr double kAgreementTolerance = 1e-4;
inline constexpr double kAllowedMissShare = 0.001;

/// Over the faces with a value; NaN when there is none.
struct ValueRange {
  double min = kNoValue, median = kNoValue, max = kNoValue;
};

struct Report {
  uint64_t faceCount = 0;  ///< Input faces.
  uint64_t triangleCount = 0;
  uint64_t vertexCount = 0;
  uint64_t componentCount = 0;
  uint64_t seedCount = 0;  ///< Triangles that cast rays.
  uint64_t rayCount = 0;
  uint64_t redoneConeCount = 0;
  uint64_t noValueCount = 0;  ///< Input faces.
  uint64_t randomSeed = 0;
  std::string backend;                           ///< "vulkan", "cpu" or "reference".
  std::string device;                            ///< Device and driver that ran, or the CPU.
  std::optional<VulkanTraceChoice> traceChoice;  ///< Which variant of the shaders traced; none without Vulkan.
  bool runsOnCpu = false;  ///< The CPU's cores do the tracing: the reference, Embree, or a CPU device.
  StageSeconds stageSeconds;
  double raysPerSecond = 0;
  SolverReport solver;  ///< name "none" when every face was a seed.
  ValueRange sdf;
  MeshDefects defects;
  std::vector<std::string> warnings;            ///< One sentence each, defects included.
  std::optional<ErrorEstimate> estimatedError;  ///< None where every face is a seed, and where nobody asked.
  uint32_t roundCount = 1;                      ///< How often seeds were placed.
  std::optional<CheckReport> check;
};

}  // namespace asdfvk
