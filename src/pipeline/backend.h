#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/report.h"
#include "asdf_vk/session.h"
#include "bvh/bvh.h"
#include "core/device_seconds.h"
#include "poisson/poisson_solver.h"
#include "predict/prediction.h"
#include "trace/cone_tracer.h"
#include "trace/encoded_scene.h"

namespace asdfvk {

/// Outputs of a tracer besides the values.
struct TracerNeeds {
  bool hits = false;  ///< The hits of the rays.
};

/// The kernels of one computation.
struct KernelNeeds {
  uint32_t rayCount = 0;
  Definition definition = Definition::Paper;
  bool hits = false;      ///< Hits are written.
  bool predicts = false;  ///< Values are predicted from hits.
  bool solves = false;    ///< Equations are solved.
  SolverChoice solver = SolverChoice::Automatic;
};

/// Makes tracers, and on a device also predictors. A backend is a Vulkan device with its pipelines, the CPU, or the
/// reference.
class Backend {
 public:
  virtual ~Backend() = default;

  /// Device and driver, or the library and the number of CPU threads.
  [[nodiscard]] virtual std::string deviceName() const = 0;
  /// One line per device: first the chosen device, then each device that was not chosen, with the reason.
  [[nodiscard]] virtual std::vector<std::string> deviceLines() const = 0;
  /// Whether the CPU traces. Also true for a CPU device of Vulkan.
  [[nodiscard]] virtual bool runsOnCpu() const { return true; }
  [[nodiscard]] virtual bool isReference() const { return false; }
  /// Variant of the last tracer; before the first tracer, the default variant. Unset without Vulkan.
  [[nodiscard]] virtual std::optional<TraceVariant> traceVariant() const { return std::nullopt; }
  /// Options of the hierarchy for the tracers.
  [[nodiscard]] virtual BvhOptions bvhOptions() const { return {.maxLeafTriangleCount = kMaxLeafTriangleCount}; }

  /// Makes the kernels of a computation, which makeTracer() and makePredictor() otherwise make. Throws Error of kind
  /// Device.
  virtual void prepare(const KernelNeeds&) {}
  /// The scene and the cone must outlive the tracer. encoded: the scene, encoded for this backend, or null.
  [[nodiscard]] virtual std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                               const TracerNeeds& needs,
                                                               std::unique_ptr<EncodedScene> encoded) = 0;
  /// Whether makePredictor() and the solvers that need a device are available.
  [[nodiscard]] virtual bool hasDevice() const { return false; }
  /// Returns a predictor on the device. The scene and the cone must outlive the predictor. Throws Error of kind Device.
  /// Precondition: hasDevice().
  [[nodiscard]] virtual std::unique_ptr<DevicePredictor> makePredictor(const TraceScene& scene, const Cone& cone);
  /// Whether predictions are made on the device. A CPU device needs more time than the CPU for the same predictions
  /// (bench/experiments.md). The number of storage buffers is not tested, because the prediction needs fewer than any
  /// solver.
  [[nodiscard]] bool predictsOnDevice(SolverChoice solver) const;
  /// The solver that SolverChoice::Automatic selects: that of the device if the device has enough storage buffers and
  /// is not a CPU device. A CPU device needs more time for the same iterations than the solver of the CPU
  /// (docs/speed.md).
  [[nodiscard]] virtual const Solver& automaticSolver() const { return defaultSolver(false); }
  /// The choice itself, or the automatic solver.
  [[nodiscard]] SolverChoice solverFor(SolverChoice choice) const;
  /// Precondition: requireSolver(choice) does not throw.
  [[nodiscard]] virtual std::unique_ptr<PoissonSolver> makeSolver(SolverChoice choice) const;
  /// Throws Error{NoDeviceForKernel} if the solver needs a device and hasDevice() is false.
  void requireSolver(SolverChoice choice) const;
  /// The time of the device so far, by its own clock; unset without timestamps.
  [[nodiscard]] virtual std::optional<DeviceSeconds> deviceSeconds() const { return std::nullopt; }
  /// Throws Error{ValidationFailed} with the first message if the validation layers are on and reported a problem.
  virtual void requireSilentValidation() const {}
};

struct NamedBackend {
  BackendChoice choice = BackendChoice::Automatic;
  std::string name;  ///< The name in kBackendNames.
  std::unique_ptr<Backend> backend;
  /// Backend::deviceLines(), then the reasons why BackendChoice::Automatic rejected other backends.
  std::vector<std::string> deviceLines;
};

/// Opens the backend that the options name; for BackendChoice::Automatic, the first one that is available. Throws
/// Error of kind Device.
[[nodiscard]] NamedBackend openBackend(const SessionOptions& options);

/// The first available backend after the one called `failed` in the order of BackendChoice::Automatic. None if the
/// options name a backend or request a device or variant of Vulkan.
[[nodiscard]] std::optional<NamedBackend> openNextBackend(const SessionOptions& options, BackendChoice failed);

/// Whether a solver needs a Vulkan device; false for SolverChoice::Automatic.
[[nodiscard]] bool solverNeedsDevice(SolverChoice solver);

/// Throws Error of kind Device.
[[nodiscard]] std::unique_ptr<Backend> makeVulkanBackend(const SessionOptions& options);

/// Encodes a scene for BackendChoice::Vulkan. The scene must outlive the result.
[[nodiscard]] std::unique_ptr<EncodedScene> encodeForVulkan(const TraceScene& scene);

}  // namespace asdfvk
