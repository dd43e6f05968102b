#pragma once

#include <doctest/doctest.h>

#include "trace/vk/vulkan_trace_choice.h"

namespace asdfvk {

enum class Fetches { All, TexelOnly };

/// Calls body(choice) for every variant of the kernels; the message of a failed check names the variant.
template <typename Body>
void forEveryVariant(Fetches fetches, const Body& body) {
  for (const TraceKernel kernel : {TraceKernel::Packet, TraceKernel::Ray, TraceKernel::Seed}) {
    for (const BvhFetch fetch : {BvhFetch::Storage, BvhFetch::Texel}) {
      if (fetches == Fetches::TexelOnly && fetch != BvhFetch::Texel) continue;
      CAPTURE(static_cast<int>(kernel));
      CAPTURE(static_cast<int>(fetch));
      body(VulkanTraceChoice{kernel, fetch});
    }
  }
}

}  // namespace asdfvk
