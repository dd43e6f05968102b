#include "vk/pipeline_cache.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "spirv/fill.comp.h"
#include "support/scoped_variable.h"
#include "support/test_device.h"
#include "vk/compute_pipeline.h"

using namespace asdfvk;

namespace {

/// An empty folder that is removed at the end of the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "asdf-vk-cache-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

VkPhysicalDeviceProperties someDevice() {
  VkPhysicalDeviceProperties device{};
  device.vendorID = 0x1002;
  device.deviceID = 0x73bf;
  for (uint8_t i = 0; i < VK_UUID_SIZE; ++i) device.pipelineCacheUUID[i] = i;
  return device;
}

/// The data of a cache of that device: its header and 1000 bytes.
std::vector<std::byte> dataOf(const VkPhysicalDeviceProperties& device) {
  VkPipelineCacheHeaderVersionOne header{
      sizeof(header), VK_PIPELINE_CACHE_HEADER_VERSION_ONE, device.vendorID, device.deviceID, {}};
  std::memcpy(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE);
  std::vector<std::byte> data(sizeof(header) + 1000);
  for (size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::byte>(i * 7);
  std::memcpy(data.data(), &header, sizeof(header));
  return data;
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

}  // namespace

TEST_CASE("a pipeline cache is read as it was written") {
  const Folder folder;
  const std::filesystem::path file = folder.path() / "new" / "folder" / "cache.bin";
  const std::vector<std::byte> data = dataOf(someDevice());
  writePipelineCacheFile(file, data);
  CHECK(readPipelineCacheFile(file, someDevice()) == data);
}

TEST_CASE("a damaged pipeline cache, and one of another device, is ignored") {
  const Folder folder;
  const std::filesystem::path file = folder.path() / "cache.bin";
  writePipelineCacheFile(file, dataOf(someDevice()));
  const std::string good = contentOf(file);
  REQUIRE(good.size() == 24 + sizeof(VkPipelineCacheHeaderVersionOne) + 1000);
  const auto isIgnored = [&](const std::string& content) {
    write(file, content);
    return readPipelineCacheFile(file, someDevice()).empty();
  };
  for (size_t at = 0; at < good.size(); at += at < 60 ? 1 : 97) {
    CAPTURE(at);
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    CHECK(isIgnored(damaged));
    CHECK(isIgnored(good.substr(0, at)));
  }
  CHECK(isIgnored(good + "x"));
  CHECK_FALSE(isIgnored(good));
  CHECK(readPipelineCacheFile(folder.path(), someDevice()).empty());
  CHECK(readPipelineCacheFile(folder.path() / "missing", someDevice()).empty());

  const auto isOfAnother = [&](auto change) {
    VkPhysicalDeviceProperties other = someDevice();
    change(other);
    return readPipelineCacheFile(file, other).empty();
  };
  CHECK(isOfAnother([](auto& other) { ++other.vendorID; }));
  CHECK(isOfAnother([](auto& other) { ++other.deviceID; }));
  CHECK(isOfAnother([](auto& other) { ++other.pipelineCacheUUID[15]; }));
}

TEST_CASE("a folder that cannot be written is no error") {
  writePipelineCacheFile("/dev/null/asdf-vk/cache.bin", dataOf(someDevice()));
  writePipelineCacheFile("/proc/asdf-vk/cache.bin", dataOf(someDevice()));
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "cache.bin");
  writePipelineCacheFile(folder.path() / "cache.bin", dataOf(someDevice()));
  CHECK(std::filesystem::is_directory(folder.path() / "cache.bin"));
}

TEST_CASE("the folder of pipeline caches is that of the user's caches, unless it is switched off") {
  {
    const test::ScopedVariable on("ASDF_VK_PIPELINE_CACHE", "");
    const test::ScopedVariable home("HOME", "/home/someone");
    {
      const test::ScopedVariable caches("XDG_CACHE_HOME", "/var/caches");
      CHECK(pipelineCacheFolder() == "/var/caches/asdf-vk");
    }
    const test::ScopedVariable caches("XDG_CACHE_HOME", "relative");
    CHECK(pipelineCacheFolder() == "/home/someone/.cache/asdf-vk");
    const test::ScopedVariable nowhere("HOME", "");
    CHECK(pipelineCacheFolder().empty());
  }
  const test::ScopedVariable caches("XDG_CACHE_HOME", "/var/caches");
  const test::ScopedVariable off("ASDF_VK_PIPELINE_CACHE", "0");
  CHECK(pipelineCacheFolder().empty());
}

TEST_CASE("the pipelines of a device are in its cache, which a later one loads") {
  const Folder folder;
  const auto instance = std::make_unique<Instance>(InstanceOptions{.validation = true});
  const auto log = instance->validationLog();
  const VkPhysicalDevice physical = instance->physicalDevices().at(0);
  {
    const Device device(physical, describeDevice(physical));
    CHECK(device.pipelineCache() != VK_NULL_HANDLE);
    const ComputePipeline pipeline(device, {"fill.comp", k_fill_comp, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, 8, {64}});
    const PipelineCache without(physical, device.handle(), {});
    CHECK(without.file().empty());
    std::filesystem::path file;
    {
      const PipelineCache first(physical, device.handle(), folder.path());
      CHECK(first.loadedByteCount() == 0);
      file = first.file();
      CHECK(file.parent_path() == folder.path());
      CHECK(file.filename().string().starts_with("pipelines-"));
    }
    CHECK_FALSE(std::filesystem::exists(file));  // It holds no pipeline.
    size_t size = 0;
    REQUIRE(vkGetPipelineCacheData(device.handle(), device.pipelineCache(), &size, nullptr) == VK_SUCCESS);
    std::vector<std::byte> data(size);
    REQUIRE(vkGetPipelineCacheData(device.handle(), device.pipelineCache(), &size, data.data()) == VK_SUCCESS);
    MESSAGE("the cache of one pipeline has " << size << " bytes");
    writePipelineCacheFile(file, data);
    const PipelineCache second(physical, device.handle(), folder.path());
    VkPipelineCacheHeaderVersionOne header{};
    REQUIRE(data.size() >= sizeof(header));
    std::memcpy(&header, data.data(), sizeof(header));
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    // A fake device has another vendor than the driver, whose caches it refuses.
    CHECK(second.loadedByteCount() == (header.vendorID == properties.vendorID ? data.size() : 0));
    CHECK(second.handle() != VK_NULL_HANDLE);
  }
  CHECK(log->messages().empty());
}

namespace {

std::vector<std::byte> givenData;  // What a driver with compiled pipelines returns; lavapipe's caches stay empty.

VkResult giveData(VkDevice, VkPipelineCache, size_t* size, void* data) {
  if (data != nullptr) std::memcpy(data, givenData.data(), givenData.size());
  *size = givenData.size();
  return VK_SUCCESS;
}

}  // namespace

TEST_CASE("a cache with new pipelines is written at its end, and not written again without further ones") {
  const Folder folder;
  const Instance instance({.validation = true});
  const VkPhysicalDevice physical = instance.physicalDevices().at(0);
  const Device device(physical, describeDevice(physical));
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  givenData = dataOf(properties);
  const PFN_vkGetPipelineCacheData driver = std::exchange(vkGetPipelineCacheData, giveData);
  std::filesystem::path file;
  { file = PipelineCache(physical, device.handle(), folder.path()).file(); }
  CHECK(readPipelineCacheFile(file, properties) == givenData);
  {
    const PipelineCache later(physical, device.handle(), folder.path());
    REQUIRE(later.loadedByteCount() == givenData.size());
    std::filesystem::remove(file);
  }
  CHECK_FALSE(std::filesystem::exists(file));
  vkGetPipelineCacheData = driver;
}
