#pragma once

#include <volk.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace asdfvk {

/// $XDG_CACHE_HOME/asdf-vk, or ~/.cache/asdf-vk. Empty where neither variable is an absolute path, and where the
/// environment variable ASDF_VK_PIPELINE_CACHE is "0".
[[nodiscard]] std::filesystem::path pipelineCacheFolder();

/// Compiled pipelines of one device. They are read from a file when it is created, and written when it is destroyed if
/// pipelines were added. A file that is missing, damaged or of another driver is ignored, and a folder that cannot be
/// written has no effect.
class PipelineCache {
 public:
  /// folder: created where it is missing; empty: no file. The device must outlive it.
  PipelineCache(VkPhysicalDevice physical, VkDevice device, const std::filesystem::path& folder);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  /// Null where the driver could not create one.
  [[nodiscard]] VkPipelineCache handle() const { return cache_; }
  /// Bytes of the file that the driver received.
  [[nodiscard]] size_t loadedByteCount() const { return loadedByteCount_; }
  /// By device and driver; empty without a folder.
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  [[nodiscard]] std::vector<std::byte> data() const;

  VkDevice device_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  std::filesystem::path file_;
  size_t loadedByteCount_ = 0;
  uint64_t loadedHash_ = 0;
};

/// The file of a cache: 8 bytes "asdfvkpc", the byte count and the FNV-1a hash of the data, little-endian, the data.
/// Replaces it atomically; a failure has no effect.
void writePipelineCacheFile(const std::filesystem::path& file, std::span<const std::byte> data) noexcept;
/// The data, empty unless the file is complete and its data starts with the header of a cache of that device.
[[nodiscard]] std::vector<std::byte> readPipelineCacheFile(const std::filesystem::path& file,
                                                           const VkPhysicalDeviceProperties& device) noexcept;

}  // namespace asdfvk
