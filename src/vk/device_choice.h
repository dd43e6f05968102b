#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace asdfvk {

enum class DeviceKind { Discrete, Integrated, Virtual, Cpu, Other };

/// What a choice between devices depends on, and the limits that programs adapt to; plain data, so that the choice can
/// be tested without a device.
struct DeviceFacts {
  std::string name;
  std::string driver;
  DeviceKind kind = DeviceKind::Other;
  uint32_t apiVersion = 0;  ///< As VK_MAKE_API_VERSION packs it.
  std::optional<uint32_t> computeQueueFamily;
  uint32_t subgroupSize = 1;
  bool hasSubgroupVote = true;  ///< In compute shaders, as all known devices of this age have.
  bool hasSubgroupArithmetic = true;
  uint32_t maxWorkgroupInvocations = 0;
  uint32_t maxWorkgroupSize = 0;  ///< In x.
  uint32_t maxStorageBuffersPerStage = 0;
  uint32_t maxWorkgroupCount = 0;      ///< In x.
  uint64_t maxStorageBufferRange = 0;  ///< Bytes.
  uint64_t maxTexelBufferElements = 0;
  uint64_t maxMemoryAllocationSize = 0;  ///< Bytes.
};

/// llvmpipe ends all loops of an invocation after this many iterations, counted for the lanes of a subgroup together,
/// and says nothing (Mesa's lp_bld_ir_common.h, LP_MAX_TGSI_LOOP_ITERATIONS). Kernels on CPU devices stay below.
inline constexpr uint32_t kCpuDeviceLoopIterationCount = 65'535;

struct DeviceRequest {
  /// An index; digits that are no index stand for a whole number in a name ("4090"), all else for a part of one without
  /// regard to case; empty: any.
  std::string selector;
  bool requireGpu = false;  ///< Refuse CPU devices.
};

struct DeviceChoice {
  std::optional<uint32_t> index;     ///< Into the facts; none when every device was refused.
  std::vector<std::string> reasons;  ///< Per device, without its name: "chosen", or why it was passed over or refused.
};

[[nodiscard]] std::string_view toString(DeviceKind kind);

/// Real GPUs before CPU devices, discrete ones first, then in the order given. A CPU device ranks last but is not
/// refused unless a GPU is required. A pure function.
[[nodiscard]] DeviceChoice chooseDevice(std::span<const DeviceFacts> devices, const DeviceRequest& request);

}  // namespace asdfvk
