#pragma once

#include <doctest/doctest.h>

#include "asdf_vk/choices.h"
#include "trace/vk/vulkan_trace_choice.h"

namespace asdfvk {

enum class Fetches { All, TexelOnly };

/// Calls body(choice) for every variant of the kernels; the message of a failed check names the variant.
template <typename Body>
void forEveryVariant(Fetches fetches, const Body& body) {
  for (const auto& kernel : kKernels) {
    for (const auto& fetch : kFetches) {
      if (fetches == Fetches::TexelOnly && fetch.second != BvhFetch::Texel) continue;
      CAPTURE(kernel.first);
      CAPTURE(fetch.first);
      body(VulkanTraceChoice{kernel.second, fetch.second});
    }
  }
}

}  // namespace asdfvk
