#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/report.h"
#include "asdf_vk/session.h"
#include "bvh/bvh.h"
#include "poisson/poisson_solver.h"
#include "predict/prediction.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

class Device;

/// Outputs of a tracer besides the values.
struct TracerNeeds {
  bool hits = false;  ///< The hits of the rays.
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
  /// The device for solvers that need one; null without Vulkan.
  [[nodiscard]] virtual const Device* device() const { return nullptr; }

  /// The scene and the cone must outlive the tracer.
  [[nodiscard]] virtual std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                               const TracerNeeds& needs) = 0;
  /// Returns a predictor on the device, or null without Vulkan. The scene and the cone must outlive the predictor.
  /// Throws Error of kind Device.
  [[nodiscard]] virtual std::unique_ptr<DevicePredictor> makePredictor(const TraceScene&, const Cone&) {
    return nullptr;
  }
  /// Throws Error{ValidationFailed} with the first message if the validation layers are on and reported a problem.
  virtual void requireSilentValidation() const {}
};

/// Options of the hierarchy for tracers of the backend.
[[nodiscard]] BvhOptions bvhOptionsFor(const Backend& backend);

struct NamedBackend {
  std::string name;
  std::unique_ptr<Backend> backend;
  /// Backend::deviceLines(), then the reasons why "auto" rejected other backends.
  std::vector<std::string> deviceLines;
};

/// Opens the backend that the options name; for "auto", the first backend that is available. Throws Error{UnknownName}
/// and Error of kind Device.
[[nodiscard]] NamedBackend openBackend(const SessionOptions& options);

/// The first available backend after the one called `failed` in the order of "auto". None if the options name a backend
/// or request a device or variant of Vulkan.
[[nodiscard]] std::optional<NamedBackend> openNextBackend(const SessionOptions& options, std::string_view failed);

/// The solver that kAutomaticSolver selects. It is the solver of the device if the device has enough storage buffers
/// and is not a CPU device. A CPU device needs more time for the same iterations than the solver of the CPU
/// (docs/speed.md).
[[nodiscard]] const Solver& automaticSolver(const Backend& backend);

/// Whether a solver of solverNames() needs a Vulkan device; false for "auto". Throws Error{UnknownName}.
[[nodiscard]] bool solverNeedsDevice(const std::string& name);

/// Throws Error of kind Device.
[[nodiscard]] std::unique_ptr<Backend> makeVulkanBackend(const SessionOptions& options);

}  // namespace asdfvk
