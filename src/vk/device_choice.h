#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

enum class DeviceKind { Discrete, Integrated, Virtual, Cpu, Other };
enum class DeviceVendor { Nvidia, Amd, Intel, Other };

/// Facts that the choice of a device depends on, and limits that programs adapt to. Plain data, so that the choice can
/// be tested without a device.
struct DeviceFacts {
  std::string name;
  std::string driver;
  DeviceKind kind = DeviceKind::Other;
  DeviceVendor vendor = DeviceVendor::Other;
  uint32_t apiVersion = 0;  ///< Packed like VK_MAKE_API_VERSION.
  std::optional<uint32_t> computeQueueFamily;
  uint32_t subgroupSize = 1;
  bool hasSubgroupVote = true;  ///< Votes in compute shaders; true on all known devices with Vulkan 1.2.
  bool hasSubgroupArithmetic = true;
  uint32_t maxWorkgroupInvocations = 0;
  uint32_t maxWorkgroupSize = 0;  ///< Greatest size of a workgroup in x.
  uint32_t maxStorageBuffersPerStage = 0;
  uint32_t maxWorkgroupCount = 0;      ///< Greatest number of workgroups in x.
  uint64_t maxStorageBufferRange = 0;  ///< Bytes.
  uint64_t maxTexelBufferElements = 0;
  uint64_t maxMemoryAllocationSize = 0;  ///< Bytes.
  bool mapsDeviceMemory = true;          ///< False imitates a device with separate memory, for tests.
  bool endsLongLoops = false;  ///< Loops of kernels must stay below kMaxLoopIterationCount: llvmpipe before Mesa 25.
};

/// Whether kernels read large read-only arrays as texels instead of from storage buffers. True on CPU devices, where
/// texels are faster, unless storage buffers can be larger. Random loads of 16 bytes from texel buffers are up to 3
/// times slower than from storage buffers on NVIDIA GPUs since Volta, and equally fast on AMD GPUs (Aaltonen,
/// https://github.com/sebbbi/perftest). Many devices allow 65,536 texels only.
[[nodiscard]] bool prefersTexels(const DeviceFacts& device);

/// llvmpipe before Mesa 25 silently ends all loops of an invocation after this many iterations, counted for the lanes
/// of a subgroup together (lp_bld_ir_common.h of Mesa, LP_MAX_TGSI_LOOP_ITERATIONS).
inline constexpr uint32_t kMaxLoopIterationCount = 65'535;
/// driverInfo: the driver information of llvmpipe, for example "Mesa 22.3.6 (LLVM 15.0.6)".
[[nodiscard]] bool llvmpipeEndsLongLoops(std::string_view driverInfo);

struct DeviceRequest {
  /// An index. A number that is not an index matches a whole number within a device name ("4090"). Other text matches a
  /// part of a name, ignoring case. Empty: any device.
  std::string selector;
  bool requireGpu = false;  ///< Refuse CPU devices.
};

struct DeviceChoice {
  std::optional<uint32_t> index;     ///< Index of the chosen device; unset if every device was refused.
  std::vector<std::string> reasons;  ///< Per device, without its name: "chosen", or the reason against it.
};

[[nodiscard]] std::string_view toString(DeviceKind kind);

/// Chooses a device: GPUs before CPU devices, discrete GPUs first, otherwise in the given order. A CPU device is
/// refused only where a GPU is required. A pure function.
[[nodiscard]] DeviceChoice chooseDevice(std::span<const DeviceFacts> devices, const DeviceRequest& request);

}  // namespace asdfvk
