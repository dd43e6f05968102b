#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/backend.h"
#include "predict/vk/vulkan_prediction.h"
#include "trace/vk/vulkan_cone_kernel.h"
#include "vk/device.h"

namespace asdfvk::bench {

/// A device with its instance, for the backends of several threads.
struct ConstantDevice {
  explicit ConstantDevice(const std::string& selector, uint32_t maxQueueCount = 1)
      : opened(openLogicalDevice(instance, {.selector = selector}, maxQueueCount)) {}

  Instance instance;
  OpenedLogicalDevice opened;
};

/// A Vulkan backend whose kernel writes constant lengths instead of tracing rays.
class ConstantBackend final : public Backend {
 public:
  /// `opened` outlives the backend.
  explicit ConstantBackend(const ConstantDevice& opened) : opened_(opened), device_(opened.opened.device) {}

  [[nodiscard]] std::string deviceName() const override { return facts().name + ", driver " + facts().driver; }
  [[nodiscard]] std::vector<std::string> deviceLines() const override { return opened_.opened.reasons; }
  [[nodiscard]] bool runsOnCpu() const override { return facts().isCpu(); }
  [[nodiscard]] std::optional<TraceVariant> traceVariant() const override {
    return defaultTraceChoice(facts()).variant();
  }
  [[nodiscard]] BvhOptions bvhOptions() const override { return {.maxLeafTriangleCount = kMaxWideLeafTriangleCount}; }
  [[nodiscard]] bool hasDevice() const override { return true; }
  [[nodiscard]] const Solver& automaticSolver() const override { return defaultSolver(!runsOnCpu()); }
  [[nodiscard]] std::unique_ptr<PoissonSolver> makeSolver(SolverChoice choice) const override {
    return asdfvk::makeSolver(choice, &device_);
  }
  [[nodiscard]] const Device& device() const { return device_; }

  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                       const TracerNeeds& needs,
                                                       std::unique_ptr<EncodedScene> encoded) override;
  [[nodiscard]] std::unique_ptr<DevicePredictor> makePredictor(const TraceScene& scene, const Cone& cone) override;

 private:
  [[nodiscard]] const DeviceFacts& facts() const { return device_.facts(); }

  const ConstantDevice& opened_;
  Device device_;
  std::map<ConeKernelRequest, std::unique_ptr<VulkanConeKernel>> kernels_;
  std::unique_ptr<VulkanPredictionKernels> predictionKernels_;
};

}  // namespace asdfvk::bench
