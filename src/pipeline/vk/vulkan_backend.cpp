#include "pipeline/vk/vulkan_backend.h"

#include <fmt/core.h>

#include <map>
#include <string>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "pipeline/lavapipe_threads.h"
#include "pipeline/vk/kernel_check.h"
#include "pipeline/vk/shared_device.h"
#include "predict/vk/vulkan_prediction.h"
#include "trace/vk/vulkan_cone_kernel.h"
#include "trace/vk/vulkan_trace_choice.h"
#include "trace/vk/vulkan_tracer.h"
#include "vk/device.h"
#include "vk/upload_queue.h"

namespace asdfvk {
namespace {

class VulkanBackend final : public Backend {
 public:
  explicit VulkanBackend(const SessionOptions& options)
      : request_(options.variant),
        shared_(openSharedDevice(options)),
        device_(shared_->opened().device),
        choice_(traceChoiceFor(facts(), request_)) {}

  [[nodiscard]] std::string deviceName() const override {
    return fmt::format("{}, driver {}", facts().name, facts().driver);
  }
  [[nodiscard]] std::vector<std::string> deviceLines() const override { return shared_->opened().reasons; }
  [[nodiscard]] bool runsOnCpu() const override { return facts().isCpu(); }
  [[nodiscard]] std::optional<TraceVariant> traceVariant() const override { return choice_.variant(); }
  [[nodiscard]] BvhOptions bvhOptions() const override { return {.maxLeafTriangleCount = kMaxWideLeafTriangleCount}; }
  [[nodiscard]] bool hasDevice() const override { return true; }
  [[nodiscard]] const Device& device() const { return device_; }

  void prepare(const KernelNeeds& needs) override {
    (void)tracing({needs.rayCount, needs.hits, choice_, needs.definition});
    if (needs.predicts && predictsOnDevice(needs.solver)) (void)prediction(needs.definition, needs.rayCount);
  }

  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                       const TracerNeeds& needs,
                                                       std::unique_ptr<EncodedScene> encoded) override {
    choice_ = traceChoiceFor(facts(), request_, scene.bvh);
    const auto rayCount = static_cast<uint32_t>(cone.directions.size());
    return makeVulkanTracer(tracing({rayCount, needs.hits, choice_, cone.definition}), scene, cone, std::move(encoded));
  }

  [[nodiscard]] std::unique_ptr<DevicePredictor> makePredictor(const TraceScene& scene, const Cone& cone) override {
    return makeVulkanPredictor(prediction(cone.definition, static_cast<uint32_t>(cone.directions.size())), scene, cone);
  }

  [[nodiscard]] const Solver& automaticSolver() const override {
    const Solver& onDevice = defaultSolver(true);
    return !runsOnCpu() && facts().maxStorageBuffersPerStage >= onDevice.storageBufferCount ? onDevice
                                                                                            : defaultSolver(false);
  }
  [[nodiscard]] std::unique_ptr<PoissonSolver> makeSolver(SolverChoice choice) const override {
    return asdfvk::makeSolver(choice, &device_);
  }

  [[nodiscard]] std::optional<DeviceSeconds> deviceSeconds() const override {
    if (facts().timestampBits == 0) return std::nullopt;
    device_.uploads().releaseEnded();  // Adds their time.
    return device_.seconds();
  }

  void requireSilentValidation() const override {
    const std::shared_ptr<ValidationLog>& log = shared_->instance().validationLog();
    if (!log) return;
    const std::vector<std::string> messages = log->messages();
    if (!messages.empty())
      throw Error(ErrorCode::ValidationFailed, fmt::format("the validation layers report {}, first: {}",
                                                           counted(messages.size(), "problem"), messages.front()));
  }

 private:
  [[nodiscard]] const DeviceFacts& facts() const { return device_.facts(); }

  /// The kernels for a request, which are made and checked at the first request.
  const VulkanConeKernel& tracing(const ConeKernelRequest& request) {
    std::unique_ptr<VulkanConeKernel>& kernel = kernels_[request];
    if (!kernel)
      shared_->makeKernels(request, [&](bool isChecked) {
        auto compiled = std::make_unique<VulkanConeKernel>(device_, request);
        if (!isChecked) requireRight(checkKernel(*compiled), "values");
        kernel = std::move(compiled);
      });
    return *kernel;
  }
  const VulkanPredictionKernels& prediction(Definition definition, uint32_t rayCount) {
    std::unique_ptr<VulkanPredictionKernels>& kernels = predictionKernels_[{definition, rayCount}];
    if (!kernels)
      shared_->makeKernels(std::pair(definition, rayCount), [&](bool isChecked) {
        auto compiled = std::make_unique<VulkanPredictionKernels>(device_, definition, rayCount);
        if (!isChecked) requireRight(checkKernels(*compiled), "predictions");
        kernels = std::move(compiled);
      });
    return *kernels;
  }

  /// Throws Error{NoUsableDevice} if the results of a kernel are wrong. computed: the word for these results.
  void requireRight(const TracerCheck& check, const char* computed) const {
    if (!check.isRefuted()) return;
    throw Error(ErrorCode::NoUsableDevice,
                fmt::format("{} computes wrong {}: {} of {} of a generated mesh have other results than on the CPU",
                            deviceName(), computed, check.differingCount, counted(check.comparedCount, "face")));
  }

  // Members are destroyed in reverse order: each member depends on the members before it.
  TraceVariant request_;
  std::shared_ptr<SharedDevice> shared_;
  Device device_;
  VulkanTraceChoice choice_;
  std::map<ConeKernelRequest, std::unique_ptr<VulkanConeKernel>> kernels_;
  std::map<std::pair<Definition, uint32_t>, std::unique_ptr<VulkanPredictionKernels>> predictionKernels_;
};

}  // namespace

const Device* vulkanDeviceOf(const Backend& backend) {
  const auto* const vulkan = dynamic_cast<const VulkanBackend*>(&backend);
  return vulkan == nullptr ? nullptr : &vulkan->device();
}

std::unique_ptr<Backend> makeVulkanBackend(const SessionOptions& options) {
  const LavapipeThreads threads;
  return std::make_unique<VulkanBackend>(options);
}

std::vector<DeviceInfo> listDevices(std::string* reason, bool requireGpu) {
  std::vector<DeviceInfo> devices;
  try {
    const Instance instance;
    const std::vector<DeviceFacts> facts = describeDevices(instance.physicalDevices());
    const DeviceRequest request{.requireGpu = requireGpu};
    const DeviceChoice choice = chooseDevice(facts, request);
    for (size_t i = 0; i < facts.size(); ++i) {
      const bool usable = chooseDevice(std::span(&facts[i], 1), request).index.has_value();
      devices.push_back(
          {facts[i].name, facts[i].driver, std::string(toString(facts[i].kind)), usable, choice.reasons[i]});
    }
  } catch (const Error& error) {
    if (reason != nullptr) *reason = error.what();
  }
  return devices;
}

}  // namespace asdfvk
