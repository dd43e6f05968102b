#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "shared/bvh_layout.h"
#include "shared/cone_layout.h"
#include "spirv/layout_probe.comp.h"
#include "support/probe.h"
#include "support/test_device.h"
#include "vk/command_list.h"

using namespace asdfvk;

namespace {

/// Two structs of which every 4-byte word is distinct, from `firstWord` on. The words are small floats' bits, so that
/// no step may take one for a NaN or flush it to zero.
template <typename T>
std::vector<T> distinctWords(uint32_t firstWord) {
  std::vector<T> items(2);
  std::vector<uint32_t> words(2 * sizeof(T) / 4);
  for (size_t i = 0; i < words.size(); ++i) words[i] = 0x3f800000u + firstWord + static_cast<uint32_t>(i);
  std::memcpy(static_cast<void*>(items.data()), words.data(), words.size() * 4);
  return items;
}

template <typename T>
void appendWords(std::vector<uint32_t>& words, const T& item) {
  const size_t begin = words.size();
  words.resize(begin + sizeof(T) / 4);
  std::memcpy(&words[begin], &item, sizeof(T));
}

template <typename T>
Buffer upload(const Device& device, const std::vector<T>& items, VkBufferUsageFlags usage) {
  return uploadBuffer(device, std::as_bytes(std::span(items)), usage);
}

}  // namespace

TEST_CASE("each field of the shared structs arrives on the device in its place") {
  const test::ValidatedDevice device;
  const auto nodes = distinctWords<DeviceWideNode>(1000);
  const auto triangles = distinctWords<DeviceTriangle>(2000);
  const auto rays = distinctWords<ConeRay>(3000);
  const auto origins = distinctWords<ConeOrigin>(4000);
  const auto seeds = distinctWords<ConeSeed>(6000);

  constexpr auto kTexel = VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
  constexpr auto kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  const Buffer nodeBuffer = upload(*device, nodes, kTexel), triangleBuffer = upload(*device, triangles, kTexel);
  const TexelView nodeView(*device, nodeBuffer), triangleView(*device, triangleBuffer);
  const Buffer rayBuffer = upload(*device, rays, kTexel), originBuffer = upload(*device, origins, kTexel);
  const Buffer seedBuffer = upload(*device, seeds, kStorage);
  const TexelView rayView(*device, rayBuffer), originView(*device, originBuffer);
  const Buffer words(*device, 4096, kStorage, MemoryKind::HostVisible);
  constexpr auto kTexels = VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
  const ComputePipeline probe(*device, {"layout_probe.comp",
                                        k_layout_probe_comp,
                                        {kTexels, kTexels, kTexels, kTexels, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                        0,
                                        {}});
  const Binding bindings[] = {nodeView, triangleView, rayView, originView, words, seedBuffer};
  test::runProbe(*device, probe, bindings);

  std::vector<uint32_t> expected;
  appendWords(expected, nodes[1]);
  appendWords(expected, triangles[1]);
  appendWords(expected, rays[1]);
  appendWords(expected, origins[1]);
  appendWords(expected, seeds[1]);
  const std::span<uint32_t> seen = words.mappedAs<uint32_t>();
  REQUIRE(expected.size() == 50);
  for (size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(seen[i] == expected[i]);
  }
}
