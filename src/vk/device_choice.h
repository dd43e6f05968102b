#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

/// In the order of preference.
enum class DeviceKind { Discrete, Integrated, Virtual, Other, Cpu };
enum class DeviceVendor { Nvidia, Amd, Intel, Other };

/// Facts for the choice of a device, and limits. Plain data, so that tests of the choice need no device.
struct DeviceFacts {
  std::string name;
  std::string driver;
  DeviceKind kind = DeviceKind::Other;
  DeviceVendor vendor = DeviceVendor::Other;
  uint32_t apiVersion = 0;  ///< Packed like VK_MAKE_API_VERSION.
  std::optional<uint32_t> computeQueueFamily;
  uint32_t computeQueueCount = 1;  ///< Queues of this family.
  uint32_t subgroupSize = 1;
  /// Sizes that a compute pipeline can require: powers of two between these two. Both are 0 if it can require none.
  uint32_t minRequiredSubgroupSize = 0, maxRequiredSubgroupSize = 0;
  bool hasSubgroupVote = true;  ///< Votes in compute shaders; true on all known devices with Vulkan 1.2.
  bool hasSubgroupArithmetic = true;
  uint32_t maxWorkgroupInvocations = 0;
  uint32_t maxWorkgroupSize = 0;  ///< Greatest size of a workgroup in x.
  uint32_t maxStorageBuffersPerStage = 0;
  uint32_t maxWorkgroupCount = 0;      ///< Greatest number of workgroups in x.
  uint64_t maxStorageBufferRange = 0;  ///< In bytes.
  uint64_t maxTexelBufferElements = 0;
  uint64_t maxMemoryAllocationSize = 0;  ///< In bytes.
  uint32_t timestampBits = 0;            ///< Valid bits of timestamps; 0: the queue has none.
  double secondsPerTimestamp = 0;
  bool mapsDeviceMemory = true;  ///< False imitates a device with separate memory, for tests.
  bool endsLongLoops = false;    ///< Loops of kernels must stay below kMaxLoopIterationCount: llvmpipe before Mesa 25.

  [[nodiscard]] bool isCpu() const { return kind == DeviceKind::Cpu; }
};

/// Whether a compute pipeline can require subgroups of this size.
[[nodiscard]] constexpr bool canRequireSubgroupSize(const DeviceFacts& device, uint32_t size) {
  return size >= device.minRequiredSubgroupSize && size <= device.maxRequiredSubgroupSize;
}

/// Whether kernels read large read-only arrays as texels instead of from storage buffers. True on CPU devices, where
/// texels are faster; but false if storage buffers can be larger than arrays of texels. On NVIDIA GPUs since Volta,
/// random loads of 16 bytes from texel buffers are up to 3 times slower than from storage buffers; on AMD GPUs both are
/// equally fast (Aaltonen, https://github.com/sebbbi/perftest). Many devices allow 65,536 texels only.
[[nodiscard]] bool prefersTexels(const DeviceFacts& device);

/// llvmpipe before Mesa 25 ends all loops of an invocation, without an error, after this many iterations. The count is
/// the sum over the lanes of a subgroup (lp_bld_ir_common.h of Mesa, LP_MAX_TGSI_LOOP_ITERATIONS).
inline constexpr uint32_t kMaxLoopIterationCount = 65'535;
/// driverInfo: the text of llvmpipe, for example "Mesa 22.3.6 (LLVM 15.0.6)".
[[nodiscard]] bool llvmpipeEndsLongLoops(std::string_view driverInfo);

struct DeviceRequest {
  /// An index, or a part of a name, ignoring case. A number that is not an index matches a whole number within a name
  /// ("4090"). Empty: any device.
  std::string selector;
  bool requireGpu = false;  ///< Refuse CPU devices.
  bool operator==(const DeviceRequest&) const = default;
};

struct DeviceChoice {
  std::optional<uint32_t> index;  ///< Index of the chosen device; unset if every device was refused.
  /// One text per device, without the name of the device: "chosen", or the reason against the device.
  std::vector<std::string> reasons;
};

[[nodiscard]] std::string_view toString(DeviceKind kind);

/// Chooses a device. GPUs come before CPU devices, and discrete GPUs before other GPUs; within these groups, the given
/// order counts. CPU devices are refused only if a GPU is required. A pure function.
[[nodiscard]] DeviceChoice chooseDevice(std::span<const DeviceFacts> devices, const DeviceRequest& request);

}  // namespace asdfvk
