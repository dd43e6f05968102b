#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/report.h"
#include "asdf_vk/session.h"
#include "poisson/poisson_solver.h"
#include "predict/prediction.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

class Device;

/// What a tracer has to provide besides the values.
struct TracerNeeds {
  bool hits = false;  ///< The hits of the rays.
};

/// Traces the rays and owns the solvers: a Vulkan device with its pipelines, the CPU, or the reference.
class Backend {
 public:
  virtual ~Backend() = default;

  /// Device and driver, or the library and the number of CPU threads.
  [[nodiscard]] virtual std::string deviceName() const = 0;
  /// One line per device: the chosen one first, then those that were not chosen, with reasons.
  [[nodiscard]] virtual std::vector<std::string> deviceLines() const = 0;
  /// Whether the CPU traces: also true for a CPU device of Vulkan.
  [[nodiscard]] virtual bool runsOnCpu() const { return true; }
  /// Whether this backend is the reference itself.
  [[nodiscard]] virtual bool isReference() const { return false; }
  /// Variant of the last tracer; before the first one the default. Unset without Vulkan.
  [[nodiscard]] virtual std::optional<TraceVariant> traceVariant() const { return std::nullopt; }
  /// For solvers that need one; null without Vulkan.
  [[nodiscard]] virtual const Device* device() const { return nullptr; }

  /// The scene and the cone must outlive the tracer.
  [[nodiscard]] virtual std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                               const TracerNeeds& needs) = 0;
  /// Predicts faces on the device; null without Vulkan. The scene and the cone must outlive it. Throws Error of kind
  /// Device.
  [[nodiscard]] virtual std::unique_ptr<DevicePredictor> makePredictor(const TraceScene&, const Cone&) {
    return nullptr;
  }
  /// Throws Error{ValidationFailed} with the first message if the validation layers are on and reported a problem.
  virtual void requireSilentValidation() const {}
};

struct NamedBackend {
  std::string name;
  std::unique_ptr<Backend> backend;
  std::vector<std::string> deviceLines;  ///< A line per device and the reasons why "auto" rejected other backends.
};

/// The backend of that name, or the first that is available for "auto". Throws Error{UnknownName} and Error of kind
/// Device.
[[nodiscard]] NamedBackend openBackend(const SessionOptions& options);

/// The first available backend after the one called `failed` in the order of "auto". None unless the options leave the
/// choice to "auto" without a request for Vulkan.
[[nodiscard]] std::optional<NamedBackend> openNextBackend(const SessionOptions& options, std::string_view failed);

/// For kAutomaticSolver: on the device where it has the storage buffers, but not on a CPU device, which needs more time
/// than the CPU for the same iterations (docs/speed.md).
[[nodiscard]] const Solver& automaticSolver(const Backend& backend);

/// Throws Error of kind Device.
[[nodiscard]] std::unique_ptr<Backend> makeVulkanBackend(const SessionOptions& options);

}  // namespace asdfvk
