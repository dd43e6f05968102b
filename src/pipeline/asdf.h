#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cone/cone.h"
#include "core/run_control.h"
#include "mesh/mesh.h"
#include "mesh/validation.h"
#include "poisson/poisson_solver.h"

/// The public API: options in, result out.
namespace asdfvk {

enum class Backend {
  Auto,       ///< The fastest there is: a GPU, else Embree, else a CPU device of Vulkan, else the reference.
  Vulkan,     ///< Vulkan or Error{Device}.
  Cpu,        ///< Embree on the CPU's cores, or Error{Device} where it was not built in.
  Reference,  ///< Double precision on the CPU.
};

enum class SolverChoice { Auto, Cg, Jacobi, Eigen };

/// What is done about closed components whose faces look the wrong way.
enum class Orientation {
  Keep,  ///< Nothing; the report names them.
  Auto,  ///< Outer shells are made to look outwards, shells inside another one inwards (cavities).
  Flip,  ///< Every face is flipped.
};

/// How many faces cast rays.
struct SeedCount {
  enum class Kind { All, Share, Count } kind = Kind::Share;
  double share = 0.1;  ///< Of the faces that can cast rays, above 0 and at most 1.
  uint64_t count = 0;
};

struct SessionOptions {
  Backend backend = Backend::Auto;
  std::string device;       ///< As DeviceRequest::selector: an index of listDevices() or a part of a name.
  bool requireGpu = false;  ///< Refuse CPU devices such as lavapipe, Embree and the reference.
};

struct Options {
  ConeOptions cone;
  SeedCount seeds;
  uint64_t randomSeed = 1;
  SolverChoice solver = SolverChoice::Auto;
  SolverOptions solverOptions;
  double guidance = 0;  ///< Multiplies the curvature term of the paper's equation.
  Orientation orientation = Orientation::Keep;
  /// Recompute so many random traced faces, and so many random faces among all, with the reference.
  std::optional<uint64_t> checkCount;
};

/// Seconds of wall clock. A stage that did not run is 0.
struct StageSeconds {
  double read = 0, geometry = 0, bvh = 0, upload = 0, trace = 0, solve = 0, write = 0;
};

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
  std::string backend;     ///< "vulkan", "cpu" or "reference".
  std::string device;      ///< Device and driver that ran, or the CPU.
  bool runsOnCpu = false;  ///< The CPU's cores do the tracing: the reference, Embree, or a CPU device.
  StageSeconds stageSeconds;
  double raysPerSecond = 0;
  SolverReport solver;  ///< name "none" when every face was a seed.
  ValueRange sdf;
  MeshDefects defects;
  std::vector<std::string> warnings;  ///< One sentence each, defects included.
  std::optional<CheckReport> check;
};

struct Result {
  std::vector<double> sdf;      ///< #I, per input face in file order, in the mesh's unit; NaN = no value.
  std::vector<uint8_t> isSeed;  ///< #I
  Report report;
};

struct DeviceInfo {
  std::string name, driver, kind;
  bool usable = false;
  std::string reason;  ///< "chosen", as it would be without --device, or why it is passed over or refused.
};
/// Every Vulkan device of this machine; empty when there is no Vulkan loader, with the reason in `reason`.
[[nodiscard]] std::vector<DeviceInfo> listDevices(std::string* reason);

/// Owns the device and its pipelines; many meshes can be computed one after another.
class Session {
 public:
  /// Throws Error{Device} with a reason when what was asked for is not there.
  explicit Session(const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The device that will run, or why Embree or the reference does; then a line per further device with why it does
  /// not.
  [[nodiscard]] const std::vector<std::string>& deviceLines() const;

  /// Throws Error{Input} for a mesh nothing can be computed on (no face, index out of range), Error{Usage},
  /// Error{Device}, Error{Cancelled}.
  /// Turns faces of the mesh over where options.orientation says so, and nothing else.
  [[nodiscard]] Result compute(Mesh& mesh, const Options& options, const RunControl& control = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asdfvk
