#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"
#include "trace/vulkan/vulkan_trace_choice.h"
#include "vk/device_choice.h"

namespace asdfvk {

/// Self-test and rate of one way to trace.
struct TracerReport {
  std::string backend;                  ///< A name of Session::backend().
  std::optional<TraceVariant> variant;  ///< Set for "vulkan".
  bool isDefault = false;               ///< Whether this is the default variant of the device.
  std::string refusal;                  ///< Set where a limit or a missing feature of the device excludes the variant.
  std::string failure;                  ///< Set where the test ended with an error.
  uint32_t comparedCount = 0, differingCount = 0;  ///< See TracerCheck; 64 faces are compared.
  bool passed = false;                             ///< The test ran and at most one face differs.
  double raysPerSecond = 0;                        ///< The best of a few runs; 0 where the test did not run.
};

/// Comparison of a solver of the device with the solver on the CPU.
struct SolverCheckReport {
  std::string name;
  std::string refusal, failure;  ///< See TracerReport.
  uint32_t unknownCount = 0;
  uint32_t iterations = 0;
  bool finishedOnCpu = false;  ///< See SolverReport.
  double difference = 0;  ///< Greatest difference from the solution on the CPU, divided by the range of that solution.
  double seconds = 0;     ///< The best of a few runs.
  bool passed = false;    ///< The solver converged and the difference is at most kSolverTolerance.
};
inline constexpr double kSolverTolerance = 1e-3;

/// Facts about a device, whether its kernels compute the values of the reference, and how fast they are.
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

  /// The variant of the device with the greatest rate among those that passed; null where there is none.
  [[nodiscard]] const TracerReport* fastest() const;
  /// Whether nothing failed, and the default variant of the device, or the requested backend, passed.
  [[nodiscard]] bool passed() const;
};

/// Measures the backend of the options; for "auto" the Vulkan device and, for comparison, the CPU. A Vulkan device is
/// measured with every kernel variant and every solver; SessionOptions::variant is ignored. secondsPerRun: a shorter
/// run is repeated with more faces, up to all of the mesh. Throws Error of kind Device where the options exclude every
/// device and backend, Error{Cancelled}.
[[nodiscard]] DeviceReport reportDevice(const SessionOptions& options, const RunControl& control,
                                        double secondsPerRun = 0.15);

}  // namespace asdfvk
