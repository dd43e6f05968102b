// Runs a compute kernel, own_kernel.comp, on the best Vulkan device. Output:
//   3 * 3 = 9, 999 * 999 = 998001
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <vector>

#include "spirv/own_kernel.comp.h"  // Made by asdfvk_shader_library() of shaders/CMakeLists.txt.
#include "vk/buffer.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"
#include "vk/instance.h"

using namespace asdfvk;

int main() {
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {});
  const Device& device = *opened.device;
  const ComputePipeline square(device, {.name = "own_kernel.comp",
                                        .spirv = k_own_kernel_comp,
                                        .bindings = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                        .pushConstantByteCount = sizeof(uint32_t)});
  std::vector<float> numbers(1000);
  std::iota(numbers.begin(), numbers.end(), 0.0f);
  const Buffer buffer = uploadBuffer(device, std::as_bytes(std::span(numbers)),
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  const BindingSet bindings(device, square, std::vector<Binding>{buffer});
  const auto count = static_cast<uint32_t>(numbers.size());
  CommandList commands(device);
  commands.begin();
  commands.dispatch(square, bindings, bytesOf(count), (count + 63) / 64);
  commands.barrier();
  commands.submitAndWait();
  downloadBuffer(device, buffer, std::as_writable_bytes(std::span(numbers)));
  std::printf("3 * 3 = %.0f, 999 * 999 = %.0f\n", static_cast<double>(numbers[3]), static_cast<double>(numbers[999]));
}
