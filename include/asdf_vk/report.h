#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/error.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

// The comments of the structs below are also those of docs/formats.md and of the dataclasses of Python, and the members
// are the keys of the JSON report: scripts/write-report-keys copies them. Struct members that are unset are null in
// JSON and None in Python.

/// The stages of a computation, in the order in which they run.
enum class Stage {
  Read,
  Geometry,   ///< Normals, areas, components, defects, orientation.
  Graph,      ///< Dual graph and edge defects.
  Bvh,        ///< Hierarchy.
  Encode,     ///< Conversion of the hierarchy to the layout of the device or of the CPU.
  Upload,     ///< Creation and release of kernels and buffers of the device; 0 without Vulkan.
  Sample,     ///< Selection of the seeds.
  Trace,      ///< Rays.
  Thickness,  ///< Measure::Thickness: greatest sections, balls, regions.
  Predict,    ///< Prediction from hits.
  Solve,      ///< Poisson equation.
  Estimate,   ///< Error estimate, with the predictions and solutions it needs.
  Smooth,
  Postprocess,  ///< Values to [0, 1], with the neighbours of each face.
  Segment,
  Write,
};
inline constexpr size_t kStageCount = 16;
/// "read", "geometry", ...
[[nodiscard]] ASDFVK_API const char* nameOf(Stage stage);

/// Wall-clock seconds of each stage. No time is counted twice; a stage that did not run has 0.
struct StageSeconds {
  std::array<double, kStageCount> seconds{};

  [[nodiscard]] double operator[](Stage stage) const { return seconds[static_cast<size_t>(stage)]; }
  [[nodiscard]] double& operator[](Stage stage) { return seconds[static_cast<size_t>(stage)]; }
};

/// Defects of a mesh. Faces are triangles, also of a mesh of polygons. Edges are those of triangles with finite corners
/// and three distinct vertices; rays ignore all other triangles.
struct MeshDefects {
  uint64_t zeroAreaFaceCount = 0;        ///< Faces without an area.
  uint64_t duplicateFaceCount = 0;       ///< Faces at the positions of an earlier face, in the same winding.
  uint64_t nonFiniteVertexCount = 0;     ///< Vertices with a non-finite coordinate.
  uint64_t nonFiniteFaceCount = 0;       ///< Faces with a non-finite corner.
  uint64_t boundaryEdgeCount = 0;        ///< Edges of one face.
  uint64_t nonManifoldEdgeCount = 0;     ///< Edges of more than two faces.
  uint64_t inconsistentEdgeCount = 0;    ///< Edges whose two faces traverse them in the same direction.
  uint64_t unreferencedVertexCount = 0;  ///< Vertices of no triangle.
  uint64_t shortPolygonCount = 0;        ///< Input faces with fewer than three corners: no triangle, no value.
};

enum class WarningCode {
  MeshDefect,           ///< One of the defects of the mesh.
  InvertedComponents,   ///< Inverted components were found and left unchanged.
  ComponentsReversed,   ///< Inverted components were reversed.
  MissingValues,        ///< Faces without a value. Details: cause "inverted", "open", or "inverted or open" if likely.
  FinishedOnCpu,        ///< The solver of the device reached the limit of float32; the CPU continued in double.
  BackendReplaced,      ///< The device failed; the backend "auto" continued with another one.
  PredictedOnCpu,       ///< The device failed to predict values; the CPU predicted them.
  SolvedOnCpu,          ///< The device failed to solve the equation; the CPU solved it.
  NotConverged,         ///< The solver stopped at its iteration limit.
  RangeDominated,       ///< The range is no scale for errors: few faces have most of it. Details: robustShare.
  ThinShell,            ///< The shape is a thin wall around a cavity: its parts are uncertain.
  PartCountDiffers,     ///< The number of parts is not the requested one.
  OnlySmallComponents,  ///< No component has 1 % of the area: each is a part.
  SkippedContent,       ///< The file has more than a surface, which was left out.
  UncertainParts,       ///< Other numbers of patches give other parts.
  CoarseParts,          ///< The faces are too large for parts.
};
/// "missingValues"
[[nodiscard]] ASDFVK_API const char* nameOf(WarningCode code);

/// A fact about the mesh or the result that a user should know.
struct Warning {
  WarningCode code = WarningCode::MeshDefect;  ///< Kind of the warning.
  std::string message;                         ///< One sentence.
  std::vector<ErrorDetail> details;            ///< Values of the sentence, by name.
};

/// The solution of the Poisson equation.
struct SolverReport {
  std::string name;             ///< "none" where nothing was interpolated.
  uint32_t iterations = 0;      ///< Iterations of the solver.
  double relativeResidual = 0;  ///< Recomputed from the solution: in double, or by a device in float32.
  bool converged = true;        ///< False: stopped at the limit of the iterations.
  bool finishedOnCpu = false;   ///< Started on a device in float32 and finished in double.
};

/// The error at a held-out face.
struct WorstFace {
  uint64_t face = 0;  ///< Input face.
  double error = 0;   ///< Divided by the range of the values.
};

/// Estimate of the error of the result, compared with tracing all faces. Held-out faces are sampled at random with a
/// probability that increases with the error indicator. They cast rays, but a separate interpolation does not use them;
/// its errors at these faces are extrapolated to all faces. The result uses them as seeds, which lowers its error; the
/// estimate corrects for that.
struct ErrorEstimate {
  double average = 0;        ///< Mean over all faces and seeds, divided by the range of the values (paper, Table 1).
  double standardError = 0;  ///< Standard error of the average.
  /// Mean error divided by the robust range of the values, from their 1st to their 99th percentile. To be preferred to
  /// the average where few faces have the extreme values (warning rangeDominated). Not finite without such a range.
  double robustAverage = 0;
  /// Median and 90th percentile of error / value over all faces, seeds included. They are 0 where as many faces are
  /// seeds, and infinite where the value of such a face is 0.
  double relativeMedian = 0, relativePercentile90 = 0;
  double relativeMedianStandardError = 0;  ///< Standard error of the relative median.
  uint64_t heldOutCount = 0;               ///< Held-out faces.
  std::vector<WorstFace> worstFaces;       ///< Held-out faces with the largest errors, in descending order.
};

/// Comparison with the double-precision reference on two random samples: of the traced faces, to verify the device, and
/// of all faces that can cast rays, to measure the interpolation error.
struct CheckReport {
  /// At least one traced face agrees, and at most the largest of 1 and 0.1 % disagree: a ray that grazes an edge may
  /// hit either of its faces. Unset without an independent comparison.
  std::optional<bool> passed;
  /// False when the reference traced the rays: no traced face is compared, and only the errors below are meaningful.
  bool independent = true;
  uint64_t tracedCount = 0;        ///< Traced faces that were recomputed.
  uint64_t agreeingCount = 0;      ///< Traced faces that differ by at most 1e-4 of the bounding-box diagonal.
  uint64_t noValueAgreeCount = 0;  ///< Traced faces without a value in both computations.
  double medianDifference = 0;     ///< Median in diagonals, over traced faces with a value in either computation.
  double worstDifference = 0;      ///< Greatest one in diagonals; infinite if only one computation has a value.
  uint64_t worstFace = 0;          ///< Input face of the worst difference.

  uint64_t comparedCount = 0;           ///< Random faces, seeds included, with a value in both computations.
  double averageError = 0;              ///< Over compared faces, divided by the range of their reference values.
  double maximumError = 0;              ///< Over compared faces, divided by the same range.
  uint64_t interpolatedCount = 0;       ///< Compared faces that were interpolated.
  double interpolatedAverageError = 0;  ///< Over interpolated faces, divided by the same range.
  double interpolatedMaximumError = 0;  ///< Over interpolated faces, divided by the same range.

  [[nodiscard]] uint64_t missCount() const { return tracedCount - agreeingCount - noValueAgreeCount; }
};
inline constexpr double kAgreementTolerance = 1e-4;  ///< Faces with a smaller difference agree; in diagonals.
inline constexpr double kAllowedMissShare = 0.001;   ///< A check passes up to this share of disagreeing faces.

/// The values of the faces that have one, each counted once whatever its area; NaN when there is none.
struct ValueRange {
  /// Least value, 1st percentile, upper median, 99th percentile, greatest value.
  double min = kNoValue, percentile1 = kNoValue, median = kNoValue, percentile99 = kNoValue, max = kNoValue;

  [[nodiscard]] double robustRange() const { return percentile99 - percentile1; }
};

/// Range of the smoothed values, in the unit of the mesh. The field "normalized" maps it to 0 .. 1.
struct PostprocessReport {
  double min = 0, max = 0;  ///< The values that become 0 and 1.
};

inline constexpr double kPartStabilityFactor = 1.25;

/// The parts, and how certain they are.
struct PartsReport {
  /// Numbers of parts at a detail divided and multiplied by 1.25 (kPartStabilityFactor): the result is stable where
  /// both are the number of segments.
  uint32_t fewestCount = 0, mostCount = 0;
  /// Mean Rand index, weighted by area, of the chosen division with those from other numbers of patches, before small
  /// parts are merged and boundaries cut: 1 where all are equal. Below about 0.9, other numbers of patches give other
  /// parts. Unset where nothing is compared (warning onlySmallComponents).
  std::optional<double> agreement;
  bool thinShell = false;          ///< The shape is a thin wall around a cavity (warning thinShell).
  std::vector<double> areaShares;  ///< Per part, of the area of all faces; sum 1.
};

/// A connected part of the surface below the limit, with the part on the other side of the same wall. Lengths in the
/// unit of the mesh.
struct ThinRegion {
  bool isSharp = false;    ///< Contains a sharp edge or tip; otherwise it is a wall.
  double min = 0;          ///< Least thickness; 0 in a sharp region.
  uint64_t minFace = 0;    ///< Input face with the least thickness.
  Vec3d place, opposite;   ///< The points of this face and of its opposing wall with the least thickness.
  uint64_t faceCount = 0;  ///< Input faces that have a part in it.
  double area = 0;         ///< Area of the part of these faces that is thin.
  double areaShare = 0;    ///< Share of the area of the mesh, or of the region of the scene.
};

/// Edges, connected over vertices, at each of which two opposing walls meet; or a vertex at which walls meet that share
/// no edge, as at the tip of a cone. The thickness there is 0, whatever the triangulation.
struct SharpEdge {
  double angleDegrees = 0;  ///< Least inner angle between the walls.
  double length = 0;        ///< Length of all edges; 0 at a tip.
  uint64_t edgeCount = 0;   ///< Number of the edges; 0 at a tip.
  Vec3d place;              ///< The middle of the edge with the least angle, or the tip.
  uint64_t face = 0;        ///< Input face at this place.
};

/// The largest ball inside of a closed component.
struct SectionBall {
  double diameter = 0;  ///< Diameter of the ball.
  Vec3d centre;         ///< Centre of the ball.
};

/// Result of the comparison with the limit.
enum class ThicknessVerdict {
  Passed,     ///< No point of the surface is thinner.
  Failed,     ///< A point is thinner; with allowed sharp edges, one outside of sharp regions.
  NotJudged,  ///< No point was found thinner, but a part of the surface could not be judged.
};
/// "passed", "failed", "notJudged"
[[nodiscard]] ASDFVK_API const char* nameOf(ThicknessVerdict verdict);

/// Input faces on which a limit cannot be judged, or not with certainty.
struct UnjudgedFaces {
  uint64_t openCount = 0;        ///< Faces of open components: what would close them may be a thin wall.
  uint64_t invertedCount = 0;    ///< Faces of closed components oriented inwards, or inconsistently.
  uint64_t degenerateCount = 0;  ///< Faces without a normal or with a corner that is not finite; left out.
  /// Faces that a face of another solid crosses. Each solid is judged on its own: the union is at least as thick.
  uint64_t crossedCount = 0;
  uint64_t selfCrossedCount = 0;  ///< Faces that a face of the same solid crosses: inside and outside are mixed up.

  /// Whether the surface may have a point that is thinner than the least thickness found.
  [[nodiscard]] bool preventVerdict() const { return openCount > 0 || invertedCount > 0 || selfCrossedCount > 0; }
};

/// The wall thickness (docs/thickness.md). Lengths in the unit of the mesh.
struct ThicknessReport {
  std::optional<ThicknessVerdict> verdict;  ///< Unset without a limit.
  std::optional<double> thinnerThan;        ///< The limit.
  bool allowsSharpEdges = false;            ///< Whether regions with a sharp edge are left out of verdict and minimum.
  /// The least thickness over all points of the surface, without sharp regions where these are allowed.
  double min = kNoValue;
  std::optional<uint64_t> minFace;             ///< Input face with the least thickness; unset without a thickness.
  std::optional<Vec3d> minPlace, minOpposite;  ///< The points of this face and of its opposing wall that have it.
  /// Percentiles of the field "thickness", by the area of the triangles.
  double percentile1 = kNoValue, percentile5 = kNoValue, median = kNoValue, percentile95 = kNoValue, max = kNoValue;
  uint64_t noValueCount = 0;                   ///< Input faces without a thickness.
  UnjudgedFaces unjudged;                      ///< Input faces on which a limit cannot be judged with certainty.
  std::optional<SectionBall> greatestSection;  ///< The largest ball inside of a closed component; unset without one.
  std::vector<SharpEdge> sharpEdges;           ///< Sharp edges and tips, by ascending angle.
  /// Area of all thin regions, and its share of the surface. NaN without a limit.
  double thinArea = kNoValue, thinAreaShare = kNoValue;
  /// Parts of the surface below the limit, both sides of a wall together: walls before sharp regions, by ascending
  /// least thickness. Empty without a limit.
  std::vector<ThinRegion> regions;
};

/// Names of the variant of the Vulkan kernels.
struct TraceVariant {
  std::string kernel;  ///< "seed", "ray" or "packet"
  std::string fetch;   ///< "texel" or "storage"
};

/// What a computation reports beside its fields.
struct Report {
  uint64_t faceCount = 0;          ///< Input faces.
  uint64_t regionFaceCount = 0;    ///< Input faces of the region of the scene; without a region all.
  uint64_t triangleCount = 0;      ///< Triangles; polygons are cut into them.
  uint64_t vertexCount = 0;        ///< Vertices of the input.
  uint64_t componentCount = 0;     ///< Connected components.
  Vec3d size;                      ///< Sides of the bounding box along x, y, z, in the unit of the mesh.
  std::string unit;                ///< Unit of length that the file states: "mm"; empty where it states none.
  uint64_t seedCount = 0;          ///< Triangles that cast rays.
  uint64_t rayCount = 0;           ///< Rays of all seeds.
  uint64_t redoneConeCount = 0;    ///< Cones beyond the limits of the device or of float32, traced by the reference.
  uint64_t noValueCount = 0;       ///< Input faces without a value; with a region only its faces.
  uint64_t clampedCount = 0;       ///< Interpolated triangles limited to the values of the seeds of their component.
  uint64_t reversedFaceCount = 0;  ///< Input faces whose orientation was reversed.
  uint64_t randomSeed = 0;         ///< Start of all random numbers.
  uint32_t roundCount = 1;         ///< Rounds of seeds.
  std::string backend;             ///< "vulkan", "cpu" or "reference".
  std::string device;              ///< Device and driver, or the CPU.
  bool runsOnCpu = false;          ///< The CPU traces: "cpu", "reference", or a CPU device of Vulkan.
  std::optional<TraceVariant> traceChoice;       ///< The variant of the Vulkan kernels; unset without Vulkan.
  StageSeconds stageSeconds;                     ///< Seconds by stage; 0 for a stage that did not run.
  double raysPerSecond = 0;                      ///< Rays over the seconds of the stage "trace".
  SolverReport solver;                           ///< The solution of the Poisson equation.
  ValueRange sdf;                                ///< The shape diameters.
  std::optional<PostprocessReport> postprocess;  ///< Set where the result has the field "normalized".
  /// Labels of the field "segment", which are 0, 1, ... and each have a face. Set where the result has this field.
  std::optional<uint32_t> segmentCount;
  std::optional<PartsReport> parts;             ///< Set where the segments are parts.
  std::optional<ThicknessReport> thickness;     ///< Set where the result has the field "thickness".
  std::optional<ErrorEstimate> estimatedError;  ///< Unset where every face is a seed, and where it was not requested.
  std::optional<CheckReport> check;             ///< Unset where it was not requested.
  MeshDefects defects;                          ///< Defects of the mesh.
  std::vector<Warning> warnings;                ///< Warnings about the mesh and the result.
};

}  // namespace asdfvk
