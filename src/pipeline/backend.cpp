#include "pipeline/backend.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/text.h"
#include "pipeline/backend_choice.h"
#include "trace/cone_tracer.h"

namespace asdfvk {
namespace {

std::string cpuThreads() { return counted(threadLimit(), "thread"); }

class CpuBackend final : public Backend {
 public:
  [[nodiscard]] std::string deviceName() const override {
    return fmt::format("CPU, {}, single precision", cpuThreads());
  }
  [[nodiscard]] std::vector<std::string> deviceLines() const override { return {fmt::format("cpu: {}", deviceName())}; }
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone, const TracerNeeds&,
                                                       std::unique_ptr<EncodedScene>) override {
    return makeCpuTracer(scene, cone);
  }
};

class ReferenceBackend final : public Backend {
 public:
  [[nodiscard]] std::string deviceName() const override {
    return fmt::format("CPU, {}, double precision", cpuThreads());
  }
  [[nodiscard]] std::vector<std::string> deviceLines() const override {
    return {fmt::format("reference: {}", deviceName())};
  }
  [[nodiscard]] bool isReference() const override { return true; }
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone, const TracerNeeds&,
                                                       std::unique_ptr<EncodedScene>) override {
    return makeReferenceTracer(scene, cone);
  }
};

template <typename T>
std::unique_ptr<Backend> makeOnCpu(const SessionOptions&) {
  return std::make_unique<T>();
}

/// make() throws Error of kind Device if the backend is not available.
struct BackendRow {
  BackendChoice choice;
  bool usesVulkan;
  std::unique_ptr<Backend> (*make)(const SessionOptions& options);
};

/// In the order in which BackendChoice::Automatic tries them.
constexpr std::array kBackends{
    BackendRow{BackendChoice::Vulkan, true, makeVulkanBackend},
    BackendRow{BackendChoice::Cpu, false, makeOnCpu<CpuBackend>},
    BackendRow{BackendChoice::Reference, false, makeOnCpu<ReferenceBackend>},
};

/// Precondition: not BackendChoice::Automatic.
auto rowOf(BackendChoice choice) {
  const auto row = std::find_if(kBackends.begin(), kBackends.end(),
                                [&](const BackendRow& candidate) { return candidate.choice == choice; });
  ASDFVK_CHECK(row != kBackends.end());
  return row;
}

NamedBackend open(const BackendRow& row, const SessionOptions& options) {
  if (!row.usesVulkan && requestsVulkan(options))
    throw Error(options.requireGpu ? ErrorCode::GpuRequired : ErrorCode::NoDeviceForKernel,
                options.requireGpu ? "a GPU was required and this backend runs on the CPU"
                                   : "a Vulkan device or kernel variant was requested and this backend has none");
  NamedBackend named{row.choice, nameOf(kBackendNames, row.choice), row.make(options), {}};
  named.deviceLines = named.backend->deviceLines();
  return named;
}

/// Opens the first of these backends that is available.
NamedBackend openFirst(std::span<const BackendRow> rows, const SessionOptions& options) {
  std::vector<std::string> rejected;
  for (const BackendRow& row : rows) {
    try {
      NamedBackend named = open(row, options);
      named.deviceLines.insert(named.deviceLines.end(), rejected.begin(), rejected.end());
      return named;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Device || requestsVulkan(options)) throw;
      rejected.push_back(fmt::format("{}: not available: {}", nameOf(kBackendNames, row.choice), error.what()));
    }
  }
  throw Error(ErrorCode::NoUsableDevice, "no backend is available");
}

}  // namespace

std::unique_ptr<DevicePredictor> Backend::makePredictor(const TraceScene&, const Cone&) {
  ASDFVK_CHECK(!"a backend without a device has no predictor");
  return nullptr;
}

std::unique_ptr<PoissonSolver> Backend::makeSolver(SolverChoice choice) const {
  return asdfvk::makeSolver(choice, nullptr);
}

bool Backend::predictsOnDevice(SolverChoice solver) const {
  return hasDevice() && (solver == SolverChoice::Automatic ? !runsOnCpu() : solverOf(solver).needsDevice);
}

SolverChoice Backend::solverFor(SolverChoice choice) const {
  return choice == SolverChoice::Automatic ? automaticSolver().choice : choice;
}

void Backend::requireSolver(SolverChoice choice) const {
  if (choice != SolverChoice::Automatic) requireUsable(solverOf(choice), hasDevice());
}

NamedBackend openBackend(const SessionOptions& options) {
  if (options.backend == BackendChoice::Automatic) return openFirst(kBackends, options);
  return open(*rowOf(options.backend), options);
}

std::optional<NamedBackend> openNextBackend(const SessionOptions& options, BackendChoice failed) {
  if (options.backend != BackendChoice::Automatic || requestsVulkan(options)) return std::nullopt;
  const auto next = rowOf(failed) + 1;
  if (next == kBackends.end()) return std::nullopt;
  return openFirst(std::span(next, kBackends.end()), options);
}

bool solverNeedsDevice(SolverChoice solver) {
  return solver != SolverChoice::Automatic && solverOf(solver).needsDevice;
}

}  // namespace asdfvk
