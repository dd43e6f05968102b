#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "support/scoped_variable.h"
#include "vk/compute_pipeline.h"
#include "vk/instance.h"

namespace asdfvk {

struct RadvKernel {
  std::map<std::string, uint64_t> statistics;
  std::string assembly;

  /// Instructions of the loops that contain no other loop, in the order of the assembly.
  [[nodiscard]] std::vector<uint32_t> innerLoops() const;
};

/// The driver RADV for a family of GPUs that need not be there. RADV ends the process for a family that it does not
/// have.
class RadvCompiler {
 public:
  RadvCompiler(const std::string& manifest, const std::string& family);
  ~RadvCompiler();
  RadvCompiler(const RadvCompiler&) = delete;
  RadvCompiler& operator=(const RadvCompiler&) = delete;

  [[nodiscard]] bool isUsable() const { return device_ != VK_NULL_HANDLE; }
  [[nodiscard]] const DeviceFacts& facts() const { return facts_; }
  /// Major version of Mesa; 0 if the driver reports none.
  [[nodiscard]] int majorVersion() const;

  [[nodiscard]] RadvKernel compile(ComputePipelineDescription description) const;

 private:
  [[nodiscard]] RadvKernel describe(VkPipeline pipeline) const;

  test::ScopedVariable drivers_, oldDrivers_, layers_, family_;
  std::unique_ptr<Instance> instance_;
  DeviceFacts facts_;
  VkDevice device_ = VK_NULL_HANDLE;
};

}  // namespace asdfvk
