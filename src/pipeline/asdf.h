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
  Auto,       ///< Vulkan where a device is usable, else the reference, with the reason in the report.
  Vulkan,     ///< Vulkan or Error{Device}.
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
  std::string device;       ///< An index of listDevices() or a part of a name; empty: the best one.
  bool requireGpu = false;  ///< Refuse CPU devices such as lavapipe, and the reference.
};

struct Options {
  ConeOptions cone;
  SeedCount seeds;
  uint64_t randomSeed = 1;
  SolverChoice solver = SolverChoice::Auto;
  SolverOptions solverOptions;
  double guidance = 0;  ///< Multiplies the curvature term of the paper's equation.
  Orientation orientation = Orientation::Keep;
  std::optional<uint64_t> checkCount;  ///< Recompute so many random faces with the reference (at most all of them).
};

/// Seconds of wall clock. A stage that did not run is 0.
struct StageSeconds {
  double read = 0, geometry = 0, bvh = 0, upload = 0, trace = 0, solve = 0, write = 0;
};

/// Differences between the result and the reference on random faces.
struct CheckReport {
  uint64_t tracedCount = 0;        ///< Checked faces whose value was traced.
  uint64_t agreeingCount = 0;      ///< Of those, within kAgreementTolerance of the box's diagonal (or both no value).
  double medianDifference = 0;     ///< Over the diagonal, traced faces.
  double worstDifference = 0;      ///< Over the diagonal, traced faces; infinite if only one side has a value.
  uint64_t worstFace = 0;          ///< Its input face.
  uint64_t interpolatedCount = 0;  ///< Checked faces whose value was interpolated and whose reference has one.
  double averageError =
      0;  ///< Over the range of the checked faces' reference values, seeds included: Table 1 of the paper.
  double maximumError = 0;  ///< Likewise.
  bool passed = false;      ///< A traced face was checked at all, and kAgreementShare of them agree.
};
inline constexpr double kAgreementTolerance = 1e-4;
inline constexpr double kAgreementShare = 0.999;

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
  std::string backend;  ///< "vulkan" or "reference".
  std::string device;   ///< Device and driver that ran, or the CPU.
  bool runsOnCpu = false;  ///< The CPU's cores do the tracing: the reference, or a CPU device.
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
  std::string reason;  ///< Why it would be chosen or is refused: a sentence.
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

  /// One line: the device that will run and why, or why the reference does.
  [[nodiscard]] const std::string& deviceLine() const;

  /// Throws Error{Input} for a mesh nothing can be computed on (no face, index out of range), Error{Usage},
  /// Error{Device}, Error{Cancelled}.
  /// Turns faces of the mesh over where options.orientation says so, and nothing else.
  [[nodiscard]] Result compute(Mesh& mesh, const Options& options, const RunControl& control = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asdfvk
