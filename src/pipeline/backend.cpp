#include "pipeline/backend.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "core/text.h"
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
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                       const TracerNeeds&) override {
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
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone,
                                                       const TracerNeeds&) override {
    return makeReferenceTracer(scene, cone);
  }
};

template <typename T>
std::unique_ptr<Backend> makeOnCpu(const SessionOptions&) {
  return std::make_unique<T>();
}

/// make() throws Error of kind Device if the backend is not available.
struct BackendRow {
  const char* name;
  bool usesVulkan;
  std::unique_ptr<Backend> (*make)(const SessionOptions& options);
};

/// In the order in which "auto" tries them.
constexpr std::array kBackends{
    BackendRow{"vulkan", true, makeVulkanBackend},
    BackendRow{"cpu", false, makeOnCpu<CpuBackend>},
    BackendRow{"reference", false, makeOnCpu<ReferenceBackend>},
};

constexpr std::string_view kAutomaticBackend = "auto";

bool requestsVulkan(const SessionOptions& options) {
  const TraceVariant& variant = options.variant;
  return options.requireGpu || !options.device.empty() || !variant.kernel.empty() || !variant.fetch.empty();
}

NamedBackend open(const BackendRow& row, const SessionOptions& options) {
  if (!row.usesVulkan && requestsVulkan(options))
    throw Error(options.requireGpu ? ErrorCode::GpuRequired : ErrorCode::NoDeviceForKernel,
                options.requireGpu ? "a GPU was required and this backend runs on the CPU"
                                   : "a Vulkan device or kernel variant was requested and this backend has none");
  NamedBackend named{row.name, row.make(options), {}};
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
      rejected.push_back(fmt::format("{}: not available: {}", row.name, error.what()));
    }
  }
  throw Error(ErrorCode::NoUsableDevice, "no backend is available");
}

}  // namespace

BvhOptions bvhOptionsFor(const Backend& backend) {
  return {.maxLeafTriangleCount = backend.device() == nullptr ? kMaxLeafTriangleCount : kMaxWideLeafTriangleCount};
}

NamedBackend openBackend(const SessionOptions& options) {
  if (options.backend != kAutomaticBackend) {
    const auto row = std::find_if(kBackends.begin(), kBackends.end(),
                                  [&](const BackendRow& candidate) { return candidate.name == options.backend; });
    if (row == kBackends.end())
      throw Error(ErrorCode::UnknownName, fmt::format("no backend is called '{}'; the names are auto, {}",
                                                      options.backend, joined(backendNames(), ", ")));
    return open(*row, options);
  }
  return openFirst(kBackends, options);
}

std::optional<NamedBackend> openNextBackend(const SessionOptions& options, std::string_view failed) {
  if (options.backend != kAutomaticBackend || requestsVulkan(options)) return std::nullopt;
  const auto row = std::find_if(kBackends.begin(), kBackends.end(),
                                [&](const BackendRow& candidate) { return candidate.name == failed; });
  if (row == kBackends.end() || row + 1 == kBackends.end()) return std::nullopt;
  return openFirst(std::span(row + 1, kBackends.end()), options);
}

bool solverNeedsDevice(const std::string& name) { return name != kAutomaticSolver && findSolver(name).needsDevice; }

std::vector<std::string> backendNames() {
  std::vector<std::string> names;
  for (const BackendRow& row : kBackends) names.emplace_back(row.name);
  return names;
}

}  // namespace asdfvk
