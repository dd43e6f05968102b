#include "pipeline/compute_backend.h"

#include <fmt/format.h>

#include <thread>
#include <utility>

#include "core/counted.h"
#include "core/error.h"
#include "poisson/vulkan_cg_solver.h"
#include "poisson/vulkan_jacobi_solver.h"
#include "trace/reference_tracer.h"
#include "trace/vulkan_tracer.h"

namespace asdfvk {

ComputeBackend::ComputeBackend(const SessionOptions& options) {
  if (options.backend == Backend::Reference) {
    if (options.requireGpu)
      throw Error(ErrorKind::Device, "a GPU was required and the reference runs on the CPU; drop one of the two");
    useReference("as asked for");
    return;
  }
  const bool mayFallBack = options.backend == Backend::Auto && !options.requireGpu && options.device.empty();
  try {
    openVulkan(options);
  } catch (const Error& error) {
    if (!mayFallBack || error.kind() != ErrorKind::Device) throw;
    device_.reset();
    instance_.reset();
    useReference(error.what());
  }
}

void ComputeBackend::openVulkan(const SessionOptions& options) {
  instance_ = std::make_unique<Instance>(InstanceOptions{.validation = validationRequestedByEnvironment()});
  OpenedDevice opened = openDevice(*instance_, {.selector = options.device, .requireGpu = options.requireGpu});
  device_ = std::move(opened.device);
  name_ = "vulkan";
  deviceName_ = fmt::format("{}, driver {}", device_->facts().name, device_->facts().driver);
  deviceLines_ = std::move(opened.reasons);
}

void ComputeBackend::useReference(const std::string& reason) {
  name_ = "reference";
  deviceName_ = fmt::format("CPU, {} threads, double precision", std::max(1u, std::thread::hardware_concurrency()));
  deviceLines_ = {fmt::format("the reference runs on the CPU: {}", reason)};
}

std::unique_ptr<ConeTracer> ComputeBackend::makeTracer(const TraceScene& scene, const Cone& cone, bool writesHits) {
  if (!device_) return makeReferenceTracer(scene, cone);
  const ConeKernelRequest request{static_cast<uint32_t>(cone.directions.size()), writesHits};
  std::unique_ptr<VulkanConeKernel>& kernel = kernels_[request];
  if (!kernel) kernel = std::make_unique<VulkanConeKernel>(*device_, request);
  return makeVulkanTracer(*kernel, scene, cone);
}

PoissonSolver& ComputeBackend::solver(SolverChoice choice) {
  if (choice == SolverChoice::Auto) {
    // On a device that is the CPU itself Eigen needs less time for the same iterations; see bench/NOTES.md.
    return solver(runsOnCpu() ? SolverChoice::Eigen : SolverChoice::Cg);
  }
  std::unique_ptr<PoissonSolver>& solver = solvers_[choice];
  if (solver) return *solver;
  if (choice == SolverChoice::Eigen) return *(solver = makeEigenSolver());
  if (!device_)
    throw Error(ErrorKind::Device,
                "this solver runs on a Vulkan device and the backend is the reference; use --solver eigen");
  solver = choice == SolverChoice::Cg ? makeVulkanCgSolver(*device_) : makeVulkanJacobiSolver(*device_);
  return *solver;
}

std::vector<double> ComputeBackend::smooth(const DualGraph& graph, std::span<const double> values,
                                           const BilateralOptions& options) {
  if (runsOnCpu()) return smoothBilaterally(graph, values, options);
  if (!bilateralKernel_) bilateralKernel_ = std::make_unique<VulkanBilateralKernel>(*device_);
  return smoothBilaterallyOnDevice(*device_, *bilateralKernel_, graph, values, options);
}

void ComputeBackend::requireSilentValidation() const {
  if (!instance_ || !instance_->validationLog()) return;
  const std::vector<std::string> messages = instance_->validationLog()->messages();
  if (!messages.empty())
    throw Error(ErrorKind::Device, fmt::format("the validation layers report {}, first: {}",
                                               counted(messages.size(), "problem"), messages.front()));
}

}  // namespace asdfvk
