#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/mesh.h"
#include "pipeline/options.h"
#include "pipeline/report.h"
#include "trace/vulkan/vulkan_trace_choice.h"

/// The public API: options in, result out.
namespace asdfvk {

enum class Backend {
  Auto,       ///< The fastest there is: a GPU, else Embree, else a CPU device of Vulkan, else the reference.
  Vulkan,     ///< Vulkan or Error{Device}.
  Cpu,        ///< Embree on the CPU's cores, or Error{Device} where it was not built in.
  Reference,  ///< Double precision on the CPU.
};

struct SessionOptions {
  Backend backend = Backend::Auto;
  std::string device;        ///< As DeviceRequest::selector: an index of listDevices() or a part of a name.
  bool requireGpu = false;   ///< Refuse CPU devices such as lavapipe, Embree and the reference.
  VulkanTraceRequest trace;  ///< Which of the shaders' variants traces; whatever is asked for asks for Vulkan too.
};

struct Result {
  std::vector<double> sdf;      ///< #I, per input face in file order, in the mesh's unit; NaN = no value.
  std::vector<uint8_t> isSeed;  ///< #I
  /// #I, what the error estimate expects of each face, in the mesh's unit: 0 at seeds that keep their value; empty
  /// without an estimate. Its scale is cross-validated, its pattern a guess: how far a face's prediction and the seeds
  /// around it are apart.
  std::vector<double> expectedError;
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
