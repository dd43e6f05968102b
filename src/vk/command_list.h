#pragma once

#include <volk.h>

#include <span>
#include <vector>

#include "vk/buffer.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// A command buffer, recorded and submitted repeatedly: begin(), record, submit(), wait(). Several lists may be in
/// flight; their work may overlap on the device.
class CommandList {
 public:
  explicit CommandList(const Device& device);
  /// Waits like finish().
  ~CommandList();
  CommandList(const CommandList&) = delete;
  CommandList& operator=(const CommandList&) = delete;

  /// Waits like wait() for an earlier submission.
  void begin();
  [[nodiscard]] VkCommandBuffer handle() const { return objects_.commands; }
  /// pushConstants: as many bytes as the pipeline describes.
  void dispatch(const ComputePipeline& pipeline, const BindingSet& bindings, std::span<const std::byte> pushConstants,
                uint32_t workgroupCount, uint32_t workgroupCountY = 1);
  /// Like dispatch(), with the workgroup counts of the VkDispatchIndirectCommand in `size`, which is read when the
  /// dispatch starts. size: created with VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT.
  void dispatchIndirect(const ComputePipeline& pipeline, const BindingSet& bindings,
                        std::span<const std::byte> pushConstants, const Buffer& size);
  /// The buffer must have VK_BUFFER_USAGE_TRANSFER_DST_BIT.
  void fillWithZeros(const Buffer& buffer);
  void copy(const Buffer& from, uint64_t fromOffset, const Buffer& to, uint64_t toOffset, uint64_t byteCount);
  /// All earlier commands finish; later kernels, copies, indirect dispatches and host reads see their writes.
  void barrier();
  /// Throws Error{Device} if the device is lost.
  void submit();
  /// Whether wait() would not wait.
  [[nodiscard]] bool hasEnded() const;
  /// Waits for the submitted commands, if any, and adds their time to Device::seconds(). Throws Error{Device} if the
  /// device is lost. There is no time limit, for two reasons: a driver reports a hanging GPU as lost, and resources of
  /// running work cannot be freed.
  void wait();
  /// Like wait(), but without exceptions. After the call, the device does not use the resources of the commands.
  void finish() noexcept;
  void submitAndWait() {
    submit();
    wait();
  }

 private:
  void bind(const ComputePipeline& pipeline, const BindingSet& bindings, std::span<const std::byte> pushConstants);

  enum class Work { Kernel, Copy };
  /// Called before each command: writes a timestamp if the kind of work changes.
  void enter(Work work);
  void addSeconds() const;

  const Device& device_;
  SubmissionObjects objects_;
  std::vector<Work> spans_;  // Between the timestamps.
  bool isPending_ = false;
};

template <typename T>
[[nodiscard]] std::span<const std::byte> bytesOf(const T& value) {
  return std::as_bytes(std::span<const T, 1>(&value, 1));
}

}  // namespace asdfvk
