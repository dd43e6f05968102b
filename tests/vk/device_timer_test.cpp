#include "vk/device_timer.h"

#include <doctest/doctest.h>

#include "core/stopwatch.h"
#include "spirv/fill.comp.h"
#include "support/test_device.h"
#include "vk/buffer.h"
#include "vk/command_list.h"
#include "vk/compute_pipeline.h"

using namespace asdfvk;

TEST_CASE("overlapping intervals count once") {
  BusyTicks ticks(64);
  ticks.add(100, 150);
  CHECK(ticks.total() == 50);
  ticks.add(140, 170);
  CHECK(ticks.total() == 70);
  ticks.add(200, 210);
  CHECK(ticks.total() == 80);
  ticks.add(190, 205);  // Within the previous one, but for its begin.
  CHECK(ticks.total() == 80);
}

TEST_CASE("intervals may cross the end of the counter") {
  BusyTicks ticks(8);
  ticks.add(250, 4);
  CHECK(ticks.total() == 10);
  ticks.add(252, 9);
  CHECK(ticks.total() == 15);
  ticks.add(0x720, 0x725);  // Bits above the valid ones are undefined.
  CHECK(ticks.total() == 20);
}

TEST_CASE("a device is busy for a part of the time of its submissions, and not between them") {
  const test::ValidatedDevice device;
  struct Push {
    uint32_t value, wordCount;
  };
  constexpr uint32_t kWordCount = 4'000'000;
  const ComputePipeline fill(*device,
                             {"fill.comp", k_fill_comp, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, sizeof(Push), {64}});
  const Buffer buffer(*device, uint64_t{kWordCount} * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::HostVisible);
  const Binding bindings[] = {buffer};
  const BindingSet set(*device, fill, bindings);
  CommandList commands(*device);
  DeviceTimer timer(*device, 2);
  const Stopwatch watch;
  double previous = 0;
  for (uint32_t i = 0; i < 4; ++i) {
    commands.begin();
    timer.begin(commands.handle(), i % 2);
    commands.dispatch(fill, set, bytesOf(Push{i, kWordCount}), kWordCount / 64);
    commands.barrier();
    timer.end(commands.handle(), i % 2);
    commands.submitAndWait();
    timer.add(i % 2);
    if (device->facts().timestampValidBits == 0) continue;
    REQUIRE(timer.seconds());
    CHECK(*timer.seconds() > previous);
    previous = *timer.seconds();
  }
  CHECK(timer.seconds().has_value() == (device->facts().timestampValidBits > 0));
  CHECK(previous < watch.seconds());
}

TEST_CASE("without timestamps nothing is measured") {
  const test::ValidatedDevice validated;
  DeviceFacts facts = validated->facts();
  facts.timestampValidBits = 0;
  const Instance instance;
  const Device device(instance.physicalDevices().at(0), facts);
  CommandList commands(device);
  DeviceTimer timer(device);
  commands.begin();
  timer.begin(commands.handle());
  timer.end(commands.handle());
  commands.submitAndWait();
  timer.add();
  CHECK_FALSE(timer.seconds());
}
