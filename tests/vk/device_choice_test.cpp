#include <doctest/doctest.h>

#include "vk/device_choice.h"

using namespace asdfvk;

namespace {

DeviceFacts device(const char* name, DeviceKind kind, uint32_t minor = 2) {
  DeviceFacts facts;
  facts.name = name;
  facts.kind = kind;
  facts.apiVersion = (1u << 22) | (minor << 12);
  facts.computeQueueFamily = 0;
  return facts;
}

}  // namespace

TEST_CASE("a discrete GPU is chosen before an integrated one before a CPU device") {
  const DeviceFacts devices[] = {device("llvmpipe", DeviceKind::Cpu), device("Iris", DeviceKind::Integrated),
                                 device("H200", DeviceKind::Discrete)};
  const DeviceChoice choice = chooseDevice(devices, {});
  REQUIRE(choice.index);
  CHECK(*choice.index == 2);
  CHECK(choice.reasons[0] == "usable but ranks behind device 2, H200");
  CHECK(choice.reasons[2] == "chosen");
}

TEST_CASE("a CPU device alone is chosen, unless a GPU is required") {
  const DeviceFacts devices[] = {device("llvmpipe", DeviceKind::Cpu)};
  CHECK(chooseDevice(devices, {}).index == 0);
  const DeviceChoice refused = chooseDevice(devices, {.requireGpu = true});
  CHECK_FALSE(refused.index);
  CHECK(refused.reasons[0].find("CPU device and a GPU was required") != std::string::npos);
}

TEST_CASE("among equals the first is chosen") {
  const DeviceFacts devices[] = {device("A", DeviceKind::Discrete), device("B", DeviceKind::Discrete)};
  CHECK(chooseDevice(devices, {}).index == 0);
}

TEST_CASE("a device is selected by its index or by a part of its name in any case") {
  const DeviceFacts devices[] = {device("NVIDIA H200", DeviceKind::Discrete), device("llvmpipe 15", DeviceKind::Cpu)};
  CHECK(chooseDevice(devices, {.selector = "1"}).index == 1);
  CHECK(chooseDevice(devices, {.selector = "LLVM"}).index == 1);
  CHECK(chooseDevice(devices, {.selector = "h200"}).index == 0);
  const DeviceChoice none = chooseDevice(devices, {.selector = "radeon"});
  CHECK_FALSE(none.index);
  CHECK(none.reasons[0].find("is not the requested device 'radeon'") != std::string::npos);
  CHECK_FALSE(chooseDevice(devices, {.selector = "2"}).index);
}

TEST_CASE("digits that are no index select a whole number in a name") {
  const DeviceFacts devices[] = {device("llvmpipe 15", DeviceKind::Cpu), device("RTX 3090", DeviceKind::Discrete),
                                 device("RTX 4090", DeviceKind::Discrete)};
  CHECK(chooseDevice(devices, {.selector = "4090"}).index == 2);
  CHECK(chooseDevice(devices, {.selector = "1"}).index == 1);
  CHECK_FALSE(chooseDevice(devices, {.selector = "90"}).index);
  CHECK_FALSE(chooseDevice(devices, {.selector = "3"}).index);
  CHECK_FALSE(chooseDevice(devices, {.selector = "99999999999999999999"}).index);
}

TEST_CASE("no reason repeats the name of its device") {
  const DeviceFacts devices[] = {device("left", DeviceKind::Discrete), device("right", DeviceKind::Integrated)};
  for (const DeviceRequest& request : {DeviceRequest{}, DeviceRequest{.selector = "right"}}) {
    const DeviceChoice choice = chooseDevice(devices, request);
    CHECK(choice.reasons[0].find("left") == std::string::npos);
    CHECK(choice.reasons[1].find("right") == std::string::npos);
  }
}

TEST_CASE("an old device and one without compute are refused with the reason") {
  DeviceFacts mute = device("mute", DeviceKind::Discrete);
  mute.computeQueueFamily.reset();
  const DeviceFacts devices[] = {device("old", DeviceKind::Discrete, 1), mute, device("llvmpipe", DeviceKind::Cpu, 3)};
  const DeviceChoice choice = chooseDevice(devices, {});
  CHECK(choice.index == 2);
  CHECK(choice.reasons[0].find("Vulkan 1.1 only") != std::string::npos);
  CHECK(choice.reasons[1].find("no queue for compute") != std::string::npos);
}

TEST_CASE("llvmpipe ends long loops before Mesa 25") {
  CHECK(llvmpipeEndsLongLoops("Mesa 22.3.6 (LLVM 15.0.6)"));
  CHECK(llvmpipeEndsLongLoops("Mesa 24.3.4"));
  CHECK_FALSE(llvmpipeEndsLongLoops("Mesa 25.0.7-2 (LLVM 19.1.7)"));
  CHECK_FALSE(llvmpipeEndsLongLoops("Mesa 100.1"));
  CHECK(llvmpipeEndsLongLoops(""));
  CHECK(llvmpipeEndsLongLoops("Mesa git"));
}

TEST_CASE("without devices nothing is chosen") {
  const DeviceChoice choice = chooseDevice({}, {});
  CHECK_FALSE(choice.index);
  CHECK(choice.reasons.empty());
}
