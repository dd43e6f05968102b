#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/asdf.h"
#include "poisson/poisson_solver.h"
#include "trace/cone_tracer.h"
#include "trace/vulkan/vulkan_cone_kernel.h"
#include "vk/open_device.h"

namespace asdfvk {

/// What traces and what solves: a Vulkan device with its pipelines, or the CPU with Embree or with the reference.
/// Kernels are compiled once and kept.
class ComputeBackend {
 public:
  /// Throws Error{Device} when what was asked for is not there.
  explicit ComputeBackend(const SessionOptions& options);

  [[nodiscard]] const std::string& name() const { return name_; }  ///< "vulkan", "cpu" or "reference"
  [[nodiscard]] const std::string& deviceName() const { return deviceName_; }
  /// See Session::deviceLines().
  [[nodiscard]] const std::vector<std::string>& deviceLines() const { return deviceLines_; }
  [[nodiscard]] const std::optional<VulkanTraceChoice>& traceChoice() const { return traceChoice_; }  ///< Of Vulkan.
  [[nodiscard]] bool isReference() const { return !device_ && !usesEmbree_; }
  /// Embree, the reference, or a Vulkan device that is the CPU itself.
  [[nodiscard]] bool runsOnCpu() const { return !device_ || device_->facts().kind == DeviceKind::Cpu; }

  /// The scene and the cone must outlive the tracer. writesHits: whether it can be asked for hits.
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                       bool writesHits = false);
  /// Throws Error{Device} for a solver that needs a device when there is none.
  [[nodiscard]] PoissonSolver& solver(SolverChoice choice);
  /// Throws Error{Device} with what the validation layers said, if they are on and said something.
  void requireSilentValidation() const;

 private:
  void openFastest(const SessionOptions& options);
  void openVulkan(const SessionOptions& options);
  void useEmbree(const std::string& reason);
  void useReference(const std::string& reason);

  // In this order: what comes later is made of what comes before and goes first.
  std::unique_ptr<Instance> instance_;
  std::unique_ptr<Device> device_;  ///< Null: the CPU.
  bool usesEmbree_ = false;
  std::map<ConeKernelRequest, std::unique_ptr<VulkanConeKernel>> kernels_;
  std::map<SolverChoice, std::unique_ptr<PoissonSolver>> solvers_;
  std::string name_, deviceName_;
  std::optional<VulkanTraceChoice> traceChoice_;
  std::vector<std::string> deviceLines_;
};

}  // namespace asdfvk
