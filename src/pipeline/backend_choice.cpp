#include "pipeline/backend_choice.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/text.h"
#include "pipeline/backend.h"

namespace asdfvk {
namespace {

constexpr uint64_t kRaysPerThread = 400'000, kRaysPerThreadOnOpenDevice = 40'000;

std::optional<uint64_t> raysOfEnvironment() {
  const char* const value = std::getenv("ASDF_VK_GPU_RAYS");
  return value != nullptr ? numberIn<uint64_t>(value) : std::nullopt;
}

}  // namespace

bool requestsVulkan(const SessionOptions& options) {
  const TraceVariant& variant = options.variant;
  return options.requireGpu || !options.device.empty() || variant.kernel || variant.fetch;
}

bool needsBackend(const Options& options) { return options.measuresDiameter() || solverNeedsDevice(options.solver); }

SessionOptions sessionOptionsFor(SessionOptions session, const Options& options) {
  if (mayUseDevice(session.backend) && !requestsVulkan(session) && !needsBackend(options))
    session.backend = BackendChoice::Cpu;
  return session;
}

uint64_t leastRaysForGpu(size_t threadCount, bool isOpen) {
  return raysOfEnvironment().value_or(threadCount * (isOpen ? kRaysPerThreadOnOpenDevice : kRaysPerThread));
}

bool mayHaveGpu(const std::filesystem::path& deviceFiles) {
#ifdef __linux__
  if (raysOfEnvironment()) return true;
  // Drivers of NVIDIA and of Windows (WSL 2); render nodes of all other drivers.
  std::error_code error;
  const auto exists = [&](const char* name) { return std::filesystem::exists(deviceFiles / name, error); };
  if (exists("nvidiactl") || exists("dxg")) return true;
  std::filesystem::directory_iterator nodes(deviceFiles / "dri", error);
  return !error && std::any_of(begin(nodes), end(nodes), [](const std::filesystem::directory_entry& node) {
    return node.path().filename().string().starts_with("renderD");
  });
#else
  (void)deviceFiles;
  return true;
#endif
}

}  // namespace asdfvk
