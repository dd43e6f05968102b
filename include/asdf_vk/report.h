#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/error.h"
#include "asdf_vk/finding.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/thickness_report.h"

namespace asdfvk {

// The members of the structs below are the keys of the JSON report and the members of the dataclasses in Python.
// asdfvk-write-documents copies the comments. An unset member is null in JSON and None in Python.

/// The stages of a computation, in the order in which they run.
enum class Stage {
  Read,
  Geometry,   ///< Normals, areas, components, defects, orientation.
  Graph,      ///< Dual graph and edge defects.
  Bvh,        ///< Construction of the bounding volume hierarchy.
  Encode,     ///< Conversion of the hierarchy to the layout of the device or of the CPU.
  Upload,     ///< Creation of kernels and buffers on the device, copies to buffers, and release; 0 without Vulkan.
  Sample,     ///< Selection of the seeds.
  Trace,      ///< Tracing of the rays.
  Thickness,  ///< Wall thickness and thin regions.
  Predict,    ///< Prediction of values from the hits of rays.
  Solve,      ///< Poisson equation.
  Estimate,   ///< Error estimate, including its own predictions and solutions.
  Smooth,
  Postprocess,  ///< Neighbours of each face, and mapping of the values to [0, 1].
  Segment,
  Write,
};
inline constexpr size_t kStageCount = 16;
/// The name of an enumerator with a small first letter, for example "read".
[[nodiscard]] ASDFVK_API const char* nameOf(Stage stage);

/// Wall-clock seconds of each stage. No time is counted twice. A stage that did not run has 0.
struct StageSeconds {
  std::array<double, kStageCount> seconds{};

  [[nodiscard]] double operator[](Stage stage) const { return seconds[static_cast<size_t>(stage)]; }
  [[nodiscard]] double& operator[](Stage stage) { return seconds[static_cast<size_t>(stage)]; }
  StageSeconds& operator+=(const StageSeconds& other) {
    for (size_t i = 0; i < kStageCount; ++i) seconds[i] += other.seconds[i];
    return *this;
  }
};

/// Defects of a mesh. Faces are counted as triangles, also in a mesh of polygons. An edge is counted only if its
/// triangles have finite corners and three distinct vertices. Rays ignore all other triangles. Edges are counted after
/// vertices were welded.
struct MeshDefects {
  uint64_t zeroAreaFaceCount = 0;      ///< Faces of zero area.
  uint64_t duplicateFaceCount = 0;     ///< Faces with the same corner positions and winding as an earlier face.
  uint64_t nonFiniteVertexCount = 0;   ///< Vertices with a non-finite coordinate.
  uint64_t nonFiniteFaceCount = 0;     ///< Faces with a non-finite corner.
  uint64_t boundaryEdgeCount = 0;      ///< Edges of exactly one face that do not lie on edges of other faces.
  uint64_t nonManifoldEdgeCount = 0;   ///< Edges that belong to more than two faces.
  uint64_t inconsistentEdgeCount = 0;  ///< Edges whose faces are wound against each other.
  uint64_t weldedVertexCount = 0;      ///< Vertices that were replaced by another vertex at the same point, or nearby.
  uint64_t unreferencedVertexCount = 0;  ///< Vertices that belong to no triangle.
  uint64_t shortPolygonCount = 0;        ///< Input faces with fewer than three corners. Such faces have no value.
};

enum class WarningCode {
  MeshDefect,           ///< The mesh has a defect. Details: defect, count.
  InvertedComponents,   ///< Inverted components were found and left unchanged.
  ComponentsReversed,   ///< Inverted components were reversed.
  FacesReversed,        ///< Faces that were wound against their neighbours were reversed. Details: count.
  MissingValues,        ///< Faces have no value. Details: cause, if likely: "inverted", "open", "inverted or open".
  FinishedOnCpu,        ///< The solver on the device reached the precision of float32. The CPU continued in double.
  BackendReplaced,      ///< The device failed. The computation continued with the next backend.
  PredictedOnCpu,       ///< The device failed to predict values. The CPU predicted the values.
  SolvedOnCpu,          ///< The device failed to solve the equation. The CPU solved the equation.
  NotConverged,         ///< The solver stopped at its iteration limit.
  RangeDominated,       ///< Errors over the range look small, because few faces have most of the range. Details:
                        ///< robustShare.
  ThinShell,            ///< The shape is a thin wall around a cavity. Parts of such shapes are uncertain.
  PartCountDiffers,     ///< The number of parts differs from the requested number.
  OnlySmallComponents,  ///< No component has 1 % of the area, so that each component is a part.
  SkippedContent,       ///< Contents of the file other than the surface were left out.
  NegativeVolumes,      ///< Negative volumes of the file were not subtracted from the surface. Details: count.
  CoarseCoordinates,    ///< The coordinates are float32 values far from the origin. Details: step.
  UncertainParts,  ///< The parts depend on the number of patches, which are the small regions that are merged to parts.
  CoarseParts,     ///< The faces are too large for exact boundaries of parts.
};
/// The name of an enumerator with a small first letter, for example "missingValues".
[[nodiscard]] ASDFVK_API const char* nameOf(WarningCode code);

/// A fact about the mesh or the result that a user should know.
struct Warning {
  WarningCode code = WarningCode::MeshDefect;  ///< Kind of the warning.
  std::string message;                         ///< The warning in one sentence.
  std::vector<ErrorDetail> details;            ///< Named values that occur in the message.
};

/// The solution of the Poisson equation.
struct SolverReport {
  std::string name;         ///< Name of the solver; "none" if no value was interpolated.
  uint32_t iterations = 0;  ///< Iterations of the solver.
  /// Relative residual of the solution, recomputed in float32 on a device, else in double.
  double relativeResidual = 0;
  bool converged = true;       ///< False if the solver stopped at its iteration limit.
  bool finishedOnCpu = false;  ///< The solver started on a device in float32 and the CPU finished in double.
};

/// The error at a held-out face.
struct WorstFace {
  uint64_t face = 0;  ///< Input face.
  double error = 0;   ///< Error divided by the range of the values.
};

/// Estimate of the error of the result, compared with a result for which all faces are traced. The held-out faces are a
/// random sample of the faces. Held-out faces cast rays, but a separate interpolation does not use their values. The
/// errors of this interpolation at the held-out faces are extrapolated to all faces. Faces with larger expected errors
/// are sampled with a higher probability. The result has smaller errors than this interpolation, because it uses the
/// values of the held-out faces. Therefore the estimate is reduced by a factor.
struct ErrorEstimate {
  /// Mean error over all faces, seeds included, divided by the range of the values (ASDF paper, Table 1).
  double average = 0;
  double standardError = 0;  ///< Standard error of the average.
  /// Mean error divided by the robust range, which is the 99th minus the 1st percentile of the values. Prefer this
  /// member to `average` if the report has the warning rangeDominated. Not finite if the robust range is 0.
  double robustAverage = 0;
  /// Median and 90th percentile of error / value over all faces, seeds included. The median is 0 if at least half of
  /// the faces are seeds; the percentile is 0 if at least 90 % of the faces are seeds. A quantile is infinite if the
  /// face at the quantile has an error and the value 0.
  double relativeMedian = 0, relativePercentile90 = 0;
  double relativeMedianStandardError = 0;  ///< Standard error of the relative median.
  uint64_t heldOutCount = 0;               ///< Number of held-out faces.
  std::vector<WorstFace> worstFaces;       ///< Held-out faces with the largest errors, in descending order.
};

/// Comparison with the double-precision reference on two random samples. A sample of the traced faces verifies the
/// device. A sample of all faces that can cast rays measures the interpolation error. Errors are divided by the range
/// of the reference values of the compared faces.
struct CheckReport {
  /// True if at least one traced face agrees, and if the number of disagreeing traced faces is at most 1 or at most 0.1
  /// %. A ray that grazes an edge may hit either face of the edge. Unset if `independent` is false.
  std::optional<bool> passed;
  /// False if the reference traced the rays of the result. In this case no traced face is compared, and only the errors
  /// have a meaning.
  bool independent = true;
  uint64_t tracedCount = 0;        ///< Traced faces that were recomputed.
  uint64_t agreeingCount = 0;      ///< Traced faces that differ by at most 1e-4 of the bounding-box diagonal.
  uint64_t noValueAgreeCount = 0;  ///< Traced faces without a value in both computations.
  /// Median difference of traced faces that have a value in at least one of the two computations, in bounding-box
  /// diagonals.
  double medianDifference = 0;
  /// Greatest difference of a traced face, in bounding-box diagonals; infinite if only one of the two values exists.
  double worstDifference = 0;
  uint64_t worstFace = 0;  ///< Input face of the worst difference.

  uint64_t comparedCount = 0;           ///< Random faces, seeds included, with a value in both computations.
  double averageError = 0;              ///< Mean error of the compared faces.
  double maximumError = 0;              ///< Greatest error of the compared faces.
  uint64_t interpolatedCount = 0;       ///< Compared faces with an interpolated value.
  double interpolatedAverageError = 0;  ///< Mean error of the interpolated faces.
  double interpolatedMaximumError = 0;  ///< Greatest error of the interpolated faces.

  [[nodiscard]] uint64_t missCount() const { return tracedCount - agreeingCount - noValueAgreeCount; }
};
/// Largest difference at which faces agree, in bounding-box diagonals.
inline constexpr double kAgreementTolerance = 1e-4;
inline constexpr double kAllowedMissShare = 0.001;  ///< Largest share of disagreeing faces with which a check passes.

/// Range and quantiles of the values; NaN if no face has a value. Each input face with a value counts once.
struct ValueRange {
  /// Least value, 1st percentile, upper median, 99th percentile, greatest value.
  double min = kNoValue, percentile1 = kNoValue, median = kNoValue, percentile99 = kNoValue, max = kNoValue;

  [[nodiscard]] double robustRange() const { return percentile99 - percentile1; }
};

/// Range of the smoothed values, in the unit of the mesh. The field "normalized" maps this range to 0 .. 1.
struct PostprocessReport {
  double min = 0, max = 0;  ///< The smoothed values that are mapped to 0 and 1.
};

inline constexpr double kPartStabilityFactor = 1.25;

/// Two adjacent parts, first < second.
struct PartBoundary {
  uint32_t first = 0, second = 0;  ///< Labels of the field "segment".
  /// How often the boundary remains, from 0 to 1: the parts are found with five numbers of patches and with thresholds
  /// from 1 / e to e times the threshold of the options. The number is the share of these variants that separate the
  /// parts, as a mean over pairs of patches. Near 0.5 a small change of the mesh may remove the boundary.
  double stability = 0;
};

/// Sizes and stability of the parts.
struct PartsReport {
  /// Numbers of parts if the option detail is divided by 1.25, and if detail is multiplied by 1.25. The result is
  /// stable if both numbers equal the number of segments.
  uint32_t fewestCount = 0, mostCount = 0;
  /// The segmentation merges patches, which are small regions, to parts. `agreement` compares the parts with the parts
  /// from each of five numbers of patches: the number is the mean of the area-weighted Rand indices. The parts are
  /// compared before small parts are merged and boundaries are cut. 1 means equal parts; below about 0.9 the parts
  /// depend on the number of patches, and people disagree more, too. Unset with the warning onlySmallComponents.
  std::optional<double> agreement;
  bool thinShell = false;                ///< The shape is a thin wall around a cavity (warning thinShell).
  std::vector<double> areaShares;        ///< Share of each part in the area of all faces; the sum is 1.
  std::vector<PartBoundary> boundaries;  ///< Ascending by `first` and `second`.
};

/// Assignment of rays to the lanes of a Vulkan device.
enum class TraceKernel {
  Packet,  ///< Like Ray, but the lanes of a subgroup traverse the hierarchy together.
  Ray,     ///< Neighbouring lanes trace the rays of one seed.
  Seed,    ///< Neighbouring lanes trace the same ray of neighbouring seeds.
};

/// How Vulkan kernels read the hierarchy.
enum class BvhFetch {
  Storage,  ///< Storage buffers.
  Texel,    ///< Storage texel buffers: much faster on llvmpipe. Many devices allow at most 65,536 texels (of 16 bytes).
};

/// Variant of the Vulkan kernels. All variants compute the same values.
struct TraceVariant {
  std::optional<TraceKernel> kernel;  ///< Assignment of rays to lanes; unset in options: the default of the device.
  /// Kind of buffers that the kernels read; unset in options: the default of the device.
  std::optional<BvhFetch> fetch;
};

/// Times of a Vulkan device, by its own clock.
struct DeviceTimes {
  StageSeconds kernels;      ///< Seconds of kernels by the stage that waits for them.
  StageSeconds copies;       ///< Seconds of copies and fills by the stage that waits for them.
  double raysPerSecond = 0;  ///< Rays divided by the seconds of kernels in the stage "trace".
};

/// Facts about a computation: mesh, device, times, errors and warnings.
struct Report {
  uint64_t faceCount = 0;        ///< Input faces.
  uint64_t regionFaceCount = 0;  ///< Input faces of the computed region; without a region, all input faces.
  uint64_t triangleCount = 0;    ///< Triangles of the triangulated mesh.
  uint64_t vertexCount = 0;      ///< Vertices of the input.
  uint64_t componentCount = 0;   ///< Connected components of the mesh.
  Vec3d size;                    ///< Sides of the bounding box along x, y, z, in the unit of the mesh.
  std::string unit;              ///< Unit of length that the file states, for example "mm"; may be empty.
  /// Greatest distance between the faces and the curved surfaces of a STEP file, in the unit of the mesh; 0 for other
  /// formats.
  double chordError = 0;
  uint64_t seedCount = 0;  ///< Triangles that cast rays.
  uint64_t rayCount = 0;   ///< Number of rays that the seeds cast.
  /// Cones that exceeded a limit of the device or of float32. The reference traced these cones.
  uint64_t redoneConeCount = 0;
  uint64_t noValueCount = 0;  ///< Input faces without a value; with a region, only faces of the region.
  /// Interpolated triangles whose value was clamped to the range of the seeds of their component.
  uint64_t clampedCount = 0;
  uint64_t reversedFaceCount = 0;  ///< Input faces whose orientation was reversed.
  uint64_t randomSeed = 0;         ///< Start value of all random numbers.
  uint32_t roundCount = 1;         ///< Number of rounds in which seeds were added.
  std::string backend;             ///< "vulkan", "cpu" or "reference".
  std::string device;              ///< Name of the device and its driver, or of the CPU.
  /// BackendChoice::Automatic takes a GPU for at least this number of rays, and the CPU for fewer. Unset if another
  /// choice was made.
  std::optional<uint64_t> leastRaysForGpu;
  bool runsOnCpu = false;                        ///< The CPU traced the rays, also as a CPU device of Vulkan.
  std::optional<TraceVariant> traceChoice;       ///< The variant of the Vulkan kernels; unset if no kernel ran.
  StageSeconds stageSeconds;                     ///< Seconds by stage; 0 for a stage that did not run.
  double raysPerSecond = 0;                      ///< Rays divided by the seconds of the stage "trace".
  std::optional<DeviceTimes> deviceTimes;        ///< Unset if no device with timestamps computed.
  SolverReport solver;                           ///< The solution of the Poisson equation.
  ValueRange sdf;                                ///< Range and quantiles of the shape diameter.
  std::optional<PostprocessReport> postprocess;  ///< Set if the result has the field "normalized".
  /// Number of segments: the field "segment" has the labels 0 to segmentCount - 1. Set if the result has this field.
  std::optional<uint32_t> segmentCount;
  std::optional<PartsReport> parts;             ///< Set if the segmentation is "parts".
  std::optional<ThicknessReport> thickness;     ///< Set if the result has the field "thickness".
  std::optional<ThicknessReport> gap;           ///< Set if the result has the field "gap".
  std::optional<ComparisonReport> comparison;   ///< Set by a comparison with a former version.
  std::vector<SealedVoid> voids;                ///< Sealed voids, if the result has the field "gap".
  std::vector<BodyContact> contacts;            ///< Bodies in contact, if the result has the field "gap".
  std::vector<Finding> findings;                ///< The places to which the verdicts refer, in one form, for programs.
  std::optional<ErrorEstimate> estimatedError;  ///< Unset if every face is a seed or no estimate was requested.
  std::optional<CheckReport> check;             ///< Unset if no check was requested.
  MeshDefects defects;                          ///< Defects of the mesh.
  std::vector<Warning> warnings;                ///< Warnings about the mesh and the result.
};

}  // namespace asdfvk
