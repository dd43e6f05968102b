#include "vk/pipeline_cache.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/atomic_file.h"

namespace asdfvk {
namespace {

constexpr std::string_view kMagic = "asdfvkpc";
constexpr uint64_t kMaxByteCount = uint64_t{256} << 20;  // Larger files are ignored.

uint64_t hashOf(std::span<const std::byte> data) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte byte : data) hash = (hash ^ static_cast<uint64_t>(byte)) * 0x100000001b3;
  return hash;
}

std::filesystem::path absolutePathIn(const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr || *value != '/') return {};
  return value;
}

std::filesystem::path fileOf(const std::filesystem::path& folder, const VkPhysicalDeviceProperties& device) {
  if (folder.empty()) return {};
  std::string name =
      fmt::format("pipelines-{:04x}-{:04x}-{:08x}-", device.vendorID, device.deviceID, device.driverVersion);
  for (const uint8_t byte : device.pipelineCacheUUID) name += fmt::format("{:02x}", byte);
  return folder / (name + ".bin");
}

bool belongsTo(std::span<const std::byte> data, const VkPhysicalDeviceProperties& device) {
  VkPipelineCacheHeaderVersionOne header{};
  if (data.size() < sizeof(header)) return false;
  std::memcpy(&header, data.data(), sizeof(header));
  return header.headerSize >= sizeof(header) && header.headerSize <= data.size() &&
         header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendorID == device.vendorID &&
         header.deviceID == device.deviceID &&
         std::equal(std::begin(header.pipelineCacheUUID), std::end(header.pipelineCacheUUID),
                    std::begin(device.pipelineCacheUUID));
}

std::vector<std::byte> readFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  char magic[kMagic.size()];
  uint64_t byteCount = 0, hash = 0;
  stream.read(magic, sizeof(magic));
  stream.read(reinterpret_cast<char*>(&byteCount), sizeof(byteCount));
  stream.read(reinterpret_cast<char*>(&hash), sizeof(hash));
  if (!stream || std::string_view(magic, sizeof(magic)) != kMagic || byteCount > kMaxByteCount) return {};
  // The size is compared before the memory is allocated.
  if (std::filesystem::file_size(file) != sizeof(magic) + sizeof(byteCount) + sizeof(hash) + byteCount) return {};
  std::vector<std::byte> data(byteCount);
  stream.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(byteCount));
  if (!stream || hashOf(data) != hash) return {};
  return data;
}

}  // namespace

std::filesystem::path pipelineCacheFolder() {
  const char* value = std::getenv("ASDF_VK_PIPELINE_CACHE");
  if (value != nullptr && std::string_view(value) == "0") return {};
  if (const std::filesystem::path folder = absolutePathIn("XDG_CACHE_HOME"); !folder.empty()) return folder / "asdf-vk";
  if (const std::filesystem::path home = absolutePathIn("HOME"); !home.empty()) return home / ".cache" / "asdf-vk";
  return {};
}

void writePipelineCacheFile(const std::filesystem::path& file, std::span<const std::byte> data) noexcept {
  try {
    std::filesystem::create_directories(file.parent_path());
    AtomicFile atomic(file);
    atomic.write(kMagic);
    atomic.put(uint64_t{data.size()});
    atomic.put(hashOf(data));
    atomic.write(data.data(), data.size());
    atomic.commit();
  } catch (...) {  // The next run compiles again.
  }
}

std::vector<std::byte> readPipelineCacheFile(const std::filesystem::path& file,
                                             const VkPhysicalDeviceProperties& device) noexcept {
  try {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return {};
    std::vector<std::byte> data = readFile(file);
    if (belongsTo(data, device)) return data;
  } catch (...) {
  }
  return {};
}

PipelineCache::PipelineCache(VkPhysicalDevice physical, VkDevice device, const std::filesystem::path& folder)
    : device_(device) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  file_ = fileOf(folder, properties);
  std::vector<std::byte> loaded;
  if (!file_.empty()) loaded = readPipelineCacheFile(file_, properties);
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  info.initialDataSize = loaded.size();
  info.pInitialData = loaded.data();
  if (vkCreatePipelineCache(device_, &info, nullptr, &cache_) == VK_SUCCESS) {
    loadedByteCount_ = loaded.size();
    loadedHash_ = hashOf(loaded);
    return;
  }
  info.initialDataSize = 0;
  if (vkCreatePipelineCache(device_, &info, nullptr, &cache_) != VK_SUCCESS) cache_ = VK_NULL_HANDLE;
}

PipelineCache::~PipelineCache() {
  if (cache_ == VK_NULL_HANDLE) return;
  try {
    const std::vector<std::byte> all = file_.empty() ? std::vector<std::byte>() : data();
    const bool isNew = all.size() != loadedByteCount_ || hashOf(all) != loadedHash_;
    if (isNew && all.size() > sizeof(VkPipelineCacheHeaderVersionOne)) writePipelineCacheFile(file_, all);
  } catch (const std::bad_alloc&) {  // Without memory for its bytes the cache is not written.
  }
  vkDestroyPipelineCache(device_, cache_, nullptr);
}

std::vector<std::byte> PipelineCache::data() const {
  size_t size = 0;
  if (vkGetPipelineCacheData(device_, cache_, &size, nullptr) != VK_SUCCESS) return {};
  std::vector<std::byte> data(size);
  if (vkGetPipelineCacheData(device_, cache_, &size, data.data()) != VK_SUCCESS) return {};
  data.resize(size);
  return data;
}

}  // namespace asdfvk
