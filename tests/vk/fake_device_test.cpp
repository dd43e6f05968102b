#include "support/fake_device.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "shared/specialization_ids.h"
#include "spirv/fill.comp.h"
#include "support/require_failure.h"
#include "vk/buffer.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

using namespace asdfvk;
using test::FakeDevice;
using test::requireFailure;
using test::ScopedVariable;

namespace {

const FakeDevice::Variables kDiscrete{{"ASDF_VK_FAKE_NAME", "Toy GPU"},      {"ASDF_VK_FAKE_TYPE", "discrete"},
                                      {"ASDF_VK_FAKE_VENDOR", "0x10de"},     {"ASDF_VK_FAKE_SUBGROUP_SIZE", "32"},
                                      {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"}, {"ASDF_VK_FAKE_POISON", "0x7fc00001"}};

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

std::vector<uint32_t> wordsOf(const Device& device, const Buffer& buffer) {
  std::vector<uint32_t> words(buffer.byteCount() / 4);
  downloadBuffer(device, buffer, std::as_writable_bytes(std::span(words)));
  return words;
}

}  // namespace

TEST_CASE("the fake device has the properties and limits that its variables request") {
  FakeDevice::Variables variables = kDiscrete;
  variables.insert(variables.end(), {{"ASDF_VK_FAKE_TEXELS", "65536"},
                                     {"ASDF_VK_FAKE_QUEUES", "3"},
                                     {"ASDF_VK_FAKE_STORAGE_RANGE", "1048576"},
                                     {"ASDF_VK_FAKE_STORAGE_BUFFERS", "5"},
                                     {"ASDF_VK_FAKE_WORKGROUP_INVOCATIONS", "128"},
                                     {"ASDF_VK_FAKE_WORKGROUP_SIZE", "64"},
                                     {"ASDF_VK_FAKE_MAX_ALLOCATION", "12345678"}});
  const FakeDevice fake(variables);
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {});
  const DeviceFacts& facts = opened.device->facts();
  CHECK(facts.name == "Toy GPU");
  CHECK(std::string(toString(facts.kind)) == "discrete GPU");
  CHECK(facts.vendor == DeviceVendor::Nvidia);
  CHECK(facts.subgroupSize == 32);
  CHECK(facts.computeQueueCount == 3);
  CHECK(facts.maxTexelBufferElements == 65'536);
  CHECK(facts.maxStorageBufferRange == 1'048'576);
  CHECK(facts.maxStorageBuffersPerStage == 5);
  CHECK(facts.maxWorkgroupInvocations == 128);
  CHECK(facts.maxWorkgroupSize == 64);
  CHECK(facts.maxMemoryAllocationSize == 12'345'678);
}

TEST_CASE("a device of exactly Vulkan 1.2.0 is described to the end, and one of 1.1 is refused") {
  FakeDevice::Variables variables = kDiscrete;
  variables.emplace_back("ASDF_VK_FAKE_MINOR_VERSION", "2");
  {
    const FakeDevice fake(variables);
    const Instance instance;
    const OpenedDevice opened = openDevice(instance, {});
    const DeviceFacts& facts = opened.device->facts();
    CHECK(facts.apiVersion == VK_API_VERSION_1_2);
    CHECK(facts.subgroupSize == 32);
    CHECK_FALSE(facts.driver.empty());
  }
  variables.back().second = "1";
  const FakeDevice fake(variables);
  const Instance instance;
  requireFailure([&] { (void)openDevice(instance, {}); }, ErrorCode::NoUsableDevice, "supports Vulkan 1.1 only");
}

TEST_CASE("a pipeline requires a size of subgroups that the device offers") {
  FakeDevice::Variables variables = kDiscrete;
  variables.insert(variables.end(),
                   {{"ASDF_VK_FAKE_MIN_SUBGROUP_SIZE", "32"}, {"ASDF_VK_FAKE_MAX_SUBGROUP_SIZE", "64"}});
  const FakeDevice fake(variables);
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {});
  const DeviceFacts& facts = opened.device->facts();
  if (facts.maxRequiredSubgroupSize == 0) {
    MESSAGE("skipped: the driver has no VK_EXT_subgroup_size_control");
    return;
  }
  CHECK(facts.minRequiredSubgroupSize == 32);
  CHECK(facts.maxRequiredSubgroupSize == 64);
  CHECK_FALSE(canRequireSubgroupSize(facts, 16));
  CHECK(canRequireSubgroupSize(facts, 32));
  CHECK_FALSE(canRequireSubgroupSize(facts, 128));
  const auto compile = [&](const Device& device, uint32_t subgroupSize) {
    const ComputePipeline fill(device, {.name = "fill.comp",
                                        .spirv = k_fill_comp,
                                        .bindings = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                        .pushConstantByteCount = 8,
                                        .specializationConstants = {{kLocalSizeXId, 64}},
                                        .requiredSubgroupSize = subgroupSize});
  };
  CHECK_NOTHROW(compile(*opened.device, 0));
  CHECK_NOTHROW(compile(*opened.device, 32));
  CHECK_THROWS_AS(compile(*opened.device, 16), Error);
  // A device that is opened without the feature.
  DeviceFacts without = facts;
  without.minRequiredSubgroupSize = without.maxRequiredSubgroupSize = 0;
  const Device plain(instance.physicalDevices().front(), without);
  CHECK_NOTHROW(compile(plain, 0));
  CHECK_THROWS_AS(compile(plain, 32), Error);
}

TEST_CASE("memory of a fake device is separate and poisoned") {
  const FakeDevice fake(kDiscrete);
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {});
  const Device& device = *opened.device;
  const Buffer local(device, 4096, kUsage, MemoryKind::DeviceLocal);
  CHECK(local.mapped() == nullptr);
  CHECK(wordsOf(device, local) == std::vector<uint32_t>(1024, 0x7fc00001));
  const Buffer host(device, 4096, kUsage, MemoryKind::HostVisible);
  REQUIRE(host.mapped() != nullptr);
  CHECK(host.mappedAs<uint32_t>()[1023] == 0x7fc00001);
}

TEST_CASE("uploads go straight to memory of the device if the host can map more than a window of it") {
  for (const uint64_t mappableByteCount : {kMaxWindowByteCount, 4 * kMaxWindowByteCount}) {
    CAPTURE(mappableByteCount);
    const bool isWindow = mappableByteCount == kMaxWindowByteCount;
    FakeDevice::Variables variables = kDiscrete;
    variables.emplace_back("ASDF_VK_FAKE_MAPPABLE_MEMORY", std::to_string(mappableByteCount));
    const FakeDevice fake(variables);
    const Instance instance;
    const OpenedDevice opened = openDevice(instance, {});
    const std::vector<uint32_t> words(5000, 7);
    const Buffer uploaded = uploadBuffer(*opened.device, std::as_bytes(std::span(words)), kUsage);
    CHECK((uploaded.mapped() != nullptr) == !isWindow);
    CHECK_FALSE(uploaded.isCached());
    CHECK(wordsOf(*opened.device, uploaded) == words);
    CHECK(Buffer(*opened.device, 4096, kUsage, MemoryKind::DeviceLocal).mapped() == nullptr);
    CHECK(Buffer(*opened.device, 4096, kUsage, MemoryKind::HostVisible).isCached());
  }
}

TEST_CASE("the validation layer sees the fake device") {
  FakeDevice::Variables variables = kDiscrete;
  variables.emplace_back("ASDF_VK_FAKE_TEXELS", "65536");
  const FakeDevice fake(variables, FakeDevice::ValidationSees::Fake);
  const auto instance = std::make_unique<Instance>(InstanceOptions{.validation = true});
  const std::shared_ptr<ValidationLog> log = instance->validationLog();
  OpenedDevice opened = openDevice(*instance, {});
  DeviceFacts unlimited = opened.device->facts();
  CHECK(log->messages().empty());
  unlimited.maxTexelBufferElements = 1u << 20;
  const Device device(instance->physicalDevices().front(), unlimited);
  {
    const Buffer buffer(device, 16 * 65'537, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT, MemoryKind::DeviceLocal);
    const TexelView view(device, buffer);
  }
  std::string all;
  for (const std::string& message : log->messages()) all += message + "\n";
  INFO(all);
  CHECK(all.find("VUID-VkBufferViewCreateInfo-range") != std::string::npos);
}

TEST_CASE("a fake device is lost at the requested submission, and for ever") {
  const FakeDevice fake(kDiscrete);
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {});
  const auto submit = [&] {
    CommandList commands(*opened.device);
    commands.begin();
    commands.submitAndWait();
  };
  {
    const ScopedVariable loss("ASDF_VK_FAKE_LOST_AT", "3");
    submit();
    submit();
    requireFailure(submit, ErrorCode::DeviceLost);
  }
  requireFailure(submit, ErrorCode::DeviceLost);
}

TEST_CASE("a buffer is in another type of memory where one allocation fails, and is an error where all fail") {
  const FakeDevice fake(kDiscrete);
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {});
  const Device& device = *opened.device;
  const auto allocate = [&](MemoryKind kind) {
    device.memory().clear();
    return Buffer(device, 64 << 20, kUsage, kind);
  };
  {
    const ScopedVariable full("ASDF_VK_FAKE_NO_MEMORY_AT", "1");
    CHECK(allocate(MemoryKind::DeviceLocal).mapped() != nullptr);
  }
  {
    const ScopedVariable full("ASDF_VK_FAKE_NO_MEMORY_AT", "4+");
    CHECK(allocate(MemoryKind::DeviceLocal).mapped() == nullptr);
    for (const MemoryKind kind : {MemoryKind::DeviceLocal, MemoryKind::HostVisible})
      requireFailure([&] { (void)allocate(kind); }, ErrorCode::OutOfDeviceMemory, "out of device memory");
  }
  CHECK(allocate(MemoryKind::HostVisible).mapped() != nullptr);
}

TEST_CASE("a variable of the fake device without a valid value is refused") {
  for (const auto& [name, value] : FakeDevice::Variables{{"ASDF_VK_FAKE_TYPE", "fast"},
                                                         {"ASDF_VK_FAKE_TEXELS", "many"},
                                                         {"ASDF_VK_FAKE_TEXELS", "0x"},
                                                         {"ASDF_VK_FAKE_SUBGROUP_SIZE", "-1"},
                                                         {"ASDF_VK_FAKE_SEPARATE_MEMORY", "yes"}}) {
    const FakeDevice fake({{name, value}});
    CHECK_THROWS_AS(Instance(), Error);
  }
}
