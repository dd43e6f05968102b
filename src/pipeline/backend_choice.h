#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "asdf_vk/options.h"
#include "asdf_vk/session.h"

namespace asdfvk {

/// Whether the options request a device or a kernel, and not only a backend.
[[nodiscard]] bool requestsVulkan(const SessionOptions& options);

/// Whether a computation uses a backend: it traces rays, or solves an equation on a device.
[[nodiscard]] bool needsBackend(const Options& options);

/// The session options, with BackendChoice::Cpu if computations with these options use no backend and no device was
/// requested.
[[nodiscard]] SessionOptions sessionOptionsFor(SessionOptions session, const Options& options);

/// BackendChoice::Automatic takes a GPU from this number of rays on, and the CPU for fewer. A thread of a CPU traces
/// about 4 million rays per second, and a GPU needs little time for the same rays (docs/speed.md). But a new process
/// waits for the device about 0.1 s longer than for the hierarchy of a mesh, and an open device takes about 0.01 s to
/// receive a mesh and to return values. The environment variable ASDF_VK_GPU_RAYS replaces this number.
[[nodiscard]] uint64_t leastRaysForGpu(size_t threadCount, bool isOpen);

/// False if this machine has no GPU: on Linux, if no driver of a kernel has made a file for a GPU, and ASDF_VK_GPU_RAYS
/// is not set. Takes microseconds, while drivers of Vulkan take a tenth of a second to list their devices.
[[nodiscard]] bool mayHaveGpu(const std::filesystem::path& deviceFiles = "/dev");

}  // namespace asdfvk
