#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"
#include "trace/vk/vulkan_trace_choice.h"
#include "vk/device_choice.h"

namespace asdfvk {

/// Self-test and rate of a backend or variant.
struct TracerReport {
  std::string backend;                  ///< Name of the backend.
  std::optional<TraceVariant> variant;  ///< Variant of the kernels; set for Vulkan.
  bool isDefault = false;               ///< The variant is the default of the device.
  std::string refusal;                  ///< Set if a limit or a missing feature of the device excludes the variant.
  std::string failure;                  ///< Set if the test ended with an error.
  uint32_t comparedCount = 0, differingCount = 0;  ///< Compared faces, and those with another value.
  bool passed = false;                             ///< The test ran and at most one face differs.
  double raysPerSecond = 0;                        ///< The best of a few runs; 0 if the test did not run.
  /// The same for the kernels alone, by the clock of the device; 0 without timestamps.
  double kernelRaysPerSecond = 0;
};

/// Comparison of a solver on the device with the solver on the CPU.
struct SolverCheckReport {
  std::string name;              ///< Name of the solver.
  std::string refusal, failure;  ///< See TracerReport.
  uint32_t unknownCount = 0;     ///< Unknowns of the equation.
  uint32_t iterations = 0;       ///< Iterations on the device.
  bool finishedOnCpu = false;    ///< The solver did not converge on the device.
  double difference = 0;  ///< Greatest difference from the solution on the CPU, divided by the range of this solution.
  double seconds = 0;     ///< The best of a few runs.
  bool passed = false;    ///< The solver converged and the difference is at most kSolverTolerance.
};
inline constexpr double kSolverTolerance = 1e-3;

struct DeviceReport {
  std::vector<std::string> deviceLines;  ///< See Session::deviceLines().
  std::optional<Error> failure;  ///< The reason why there is no Vulkan device, or the report of the validation layers.
  std::optional<DeviceFacts> device;  ///< Unset without a Vulkan device.
  VulkanTraceChoice choice;           ///< The default variant of the device.
  std::string defaultSolver;
  uint64_t faceCount = 0;  ///< Faces of the generated mesh.
  uint32_t rayCount = 0;   ///< Rays per cone.
  std::vector<TracerReport> tracers;
  std::vector<SolverCheckReport> solvers;

  /// The fastest variant of the device that passed; null if no variant passed.
  [[nodiscard]] const TracerReport* fastest() const;
  /// True if nothing failed, and the requested backend or the default variant of the device passed.
  [[nodiscard]] bool passed() const;
};

/// Measures the backend of the options. For BackendChoice::Automatic, measures the Vulkan device and, for comparison,
/// the CPU. A Vulkan device is measured with every kernel variant and every solver, whatever SessionOptions::variant
/// is. A run that takes less than secondsPerRun is repeated with more faces, at most with all faces of the mesh. Throws
/// Error of kind Device if the options exclude every device and backend, and Error{Cancelled}.
[[nodiscard]] DeviceReport reportDevice(const SessionOptions& options, const RunControl& control,
                                        double secondsPerRun = 0.15);

}  // namespace asdfvk
