#include "pipeline/compute_backend.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "poisson/vulkan/vulkan_cg_solver.h"
#include "poisson/vulkan/vulkan_jacobi_solver.h"
#include "trace/embree/embree_tracer.h"
#include "trace/reference_tracer.h"
#include "trace/vulkan/vulkan_tracer.h"

namespace asdfvk {
namespace {

/// As many as this process uses at once.
size_t cpuThreadCount() { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); }

}  // namespace

ComputeBackend::ComputeBackend(const SessionOptions& options) {
  const bool isCpu = options.backend == Backend::Cpu || options.backend == Backend::Reference;
  if (isCpu && options.requireGpu)
    throw Error(ErrorCode::GpuRequired, "a GPU was required and this backend runs on the CPU; drop one of the two");
  if (isCpu && !options.trace.isEmpty())
    throw Error(ErrorCode::NoDeviceForKernel,
                "a variant of the shaders was asked for and this backend has none; drop one of the two");
  if (options.backend == Backend::Reference) {
    useReference("as asked for");
  } else if (options.backend == Backend::Cpu) {
    requireEmbree();
    useEmbree("as asked for");
  } else if (options.backend == Backend::Vulkan || options.requireGpu || !options.device.empty() ||
             !options.trace.isEmpty()) {
    openVulkan(options);
  } else {
    openFastest(options);
  }
}

// A GPU is faster than the CPU, and Embree on the CPU's cores than the shaders on them; see docs/speed.md.
void ComputeBackend::openFastest(const SessionOptions& options) {
  std::string reason;
  try {
    openVulkan(options);
    if (!runsOnCpu() || !hasEmbree()) return;
    reason = fmt::format("there is no GPU, and on the CPU it is faster than {}", device_->facts().name);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Device) throw;
    reason = error.what();
  }
  traceChoice_.reset();
  device_.reset();
  instance_.reset();
  if (hasEmbree()) {
    useEmbree(reason);
  } else {
    useReference(reason);
  }
}

void ComputeBackend::openVulkan(const SessionOptions& options) {
  instance_ = std::make_unique<Instance>(InstanceOptions{.validation = validationRequestedByEnvironment()});
  OpenedDevice opened = openDevice(*instance_, {.selector = options.device, .requireGpu = options.requireGpu});
  device_ = std::move(opened.device);
  name_ = "vulkan";
  deviceName_ = fmt::format("{}, driver {}", device_->facts().name, device_->facts().driver);
  traceChoice_ = traceChoiceFor(device_->facts(), options.trace);
  deviceLines_ = std::move(opened.reasons);
}

void ComputeBackend::useEmbree(const std::string& reason) {
  usesEmbree_ = true;
  name_ = "cpu";
  deviceName_ = fmt::format("{} on {}", embreeName(), counted(cpuThreadCount(), "thread"));
  deviceLines_ = {fmt::format("{}: {}", deviceName_, reason)};
}

void ComputeBackend::useReference(const std::string& reason) {
  name_ = "reference";
  deviceName_ = fmt::format("CPU, {}, double precision", counted(cpuThreadCount(), "thread"));
  deviceLines_ = {fmt::format("the reference runs on the CPU: {}", reason)};
}

std::unique_ptr<ConeTracer> ComputeBackend::makeTracer(const TraceScene& scene, const Cone& cone, bool writesHits) {
  if (usesEmbree_) return makeEmbreeTracer(scene, cone);
  if (!device_) return makeReferenceTracer(scene, cone);
  const ConeKernelRequest request{static_cast<uint32_t>(cone.directions.size()), writesHits, traceChoice_};
  std::unique_ptr<VulkanConeKernel>& kernel = kernels_[request];
  if (!kernel) kernel = std::make_unique<VulkanConeKernel>(*device_, request);
  return makeVulkanTracer(*kernel, scene, cone);
}

PoissonSolver& ComputeBackend::solver(SolverChoice choice) {
  if (choice == SolverChoice::Auto) {
    // On a device that is the CPU itself its own loops need less time for the same iterations; see docs/speed.md.
    return solver(runsOnCpu() ? SolverChoice::Cpu : SolverChoice::Cg);
  }
  std::unique_ptr<PoissonSolver>& solver = solvers_[choice];
  if (solver) return *solver;
  if (choice == SolverChoice::Cpu) return *(solver = makeCpuCgSolver());
  if (choice == SolverChoice::Eigen) return *(solver = makeEigenSolver());
  if (!device_)
    throw Error(ErrorCode::NoDeviceForKernel,
                "this solver runs on a Vulkan device and the backend on the CPU; use --backend vulkan or --solver cpu");
  solver = choice == SolverChoice::Cg ? makeVulkanCgSolver(*device_) : makeVulkanJacobiSolver(*device_);
  return *solver;
}

void ComputeBackend::requireSilentValidation() const {
  if (!instance_ || !instance_->validationLog()) return;
  const std::vector<std::string> messages = instance_->validationLog()->messages();
  if (!messages.empty())
    throw Error(ErrorCode::ValidationFailed, fmt::format("the validation layers report {}, first: {}",
                                                         counted(messages.size(), "problem"), messages.front()));
}

}  // namespace asdfvk
