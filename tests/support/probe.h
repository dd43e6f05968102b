#pragma once

#include <span>

#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

namespace asdfvk::test {

/// Runs one workgroup of a kernel that copies the fields of structs, and waits for it.
inline void runProbe(const Device& device, const ComputePipeline& probe, std::span<const Binding> bindings,
                     std::span<const std::byte> pushConstants = {}) {
  const BindingSet set(device, probe, bindings);
  CommandList commands(device);
  commands.begin();
  commands.dispatch(probe, set, pushConstants, 1);
  commands.barrier();
  commands.submitAndWait();
}

}  // namespace asdfvk::test
