#pragma once

#include <volk.h>

#include <cstdint>
#include <optional>

#include "vk/device.h"

namespace asdfvk {

/// Sum of intervals of a counter that starts again at 2^validBits, without the parts in which intervals overlap.
class BusyTicks {
 public:
  /// validBits: 1 to 64.
  explicit BusyTicks(uint32_t validBits) : mask_(validBits >= 64 ? ~uint64_t{0} : (uint64_t{1} << validBits) - 1) {}

  /// Adds an interval. Intervals come in the order of submission; each lasts less than half of the range of the
  /// counter.
  void add(uint64_t begin, uint64_t end);
  [[nodiscard]] uint64_t total() const { return total_; }

 private:
  /// The counter reaches `later` no earlier than `earlier`.
  [[nodiscard]] bool isOrdered(uint64_t earlier, uint64_t later) const {
    return ((later - earlier) & mask_) <= mask_ / 2;
  }

  uint64_t mask_, total_ = 0;
  std::optional<uint64_t> lastEnd_;
};

/// Time that a device is busy with submissions, by its timestamps. Without timestamps on the queue, nothing is recorded
/// and seconds() is unset.
class DeviceTimer {
 public:
  /// slotCount: submissions that may be in flight.
  explicit DeviceTimer(const Device& device, uint32_t slotCount = 1);
  ~DeviceTimer();
  DeviceTimer(const DeviceTimer&) = delete;
  DeviceTimer& operator=(const DeviceTimer&) = delete;

  /// Records the begin of a submission, as its first command.
  void begin(VkCommandBuffer commands, uint32_t slot = 0);
  /// Records its end, as its last command.
  void end(VkCommandBuffer commands, uint32_t slot = 0);
  /// Adds its time, after it has finished; once per submission and in their order.
  void add(uint32_t slot = 0);

  [[nodiscard]] std::optional<double> seconds() const;

 private:
  VkDevice device_;
  VkQueryPool pool_ = VK_NULL_HANDLE;  // Two queries per slot.
  double secondsPerTick_;
  BusyTicks ticks_;
};

}  // namespace asdfvk
