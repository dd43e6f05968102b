#include <doctest/doctest.h>

#include <cstring>
#include <numeric>
#include <vector>

#include "shared/prediction_layout.h"
#include "spirv/hit_points.comp.h"
#include "spirv/predict_faces.comp.h"
#include "spirv/prediction_layout_probe.comp.h"
#include "support/probe.h"
#include "support/specialization_ids.h"
#include "support/test_device.h"
#include "vk/command_list.h"

using namespace asdfvk;

namespace {

struct PredictionStructs {
  PredictionFace face;
  PredictionRay ray;
  PredictionSeed seed;
  PredictionPoint point;
};

}  // namespace

TEST_CASE("each field of the structs of the prediction arrives on the device in its place") {
  const test::ValidatedDevice device;
  constexpr size_t kStructWordCount = sizeof(PredictionStructs) / 4, kPushWordCount = sizeof(PredictionPush) / 4;
  std::vector<uint32_t> expected(kStructWordCount + kPushWordCount);
  std::iota(expected.begin(), expected.end(), 0x3f800001u);  // Bits of floats that no step flushes or takes for a NaN.
  PredictionStructs structs;
  PredictionPush push;
  std::memcpy(&structs, expected.data(), sizeof structs);
  std::memcpy(&push, &expected[kStructWordCount], sizeof push);
  const Buffer blocks = uploadBuffer(*device, bytesOf(structs), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer words(*device, expected.size() * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::HostVisible);
  const ComputePipeline probe(*device, {"prediction_layout_probe.comp",
                                        k_prediction_layout_probe_comp,
                                        std::vector(2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
                                        sizeof push,
                                        {}});
  test::runProbe(*device, probe, std::vector<Binding>{blocks, words}, bytesOf(push));
  const std::span<uint32_t> seen = words.mappedAs<uint32_t>();
  for (size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(seen[i] == expected[i]);
  }
}

TEST_CASE("each specialization constant of the shaders of the prediction has an id of its own") {
  CHECK(test::hasDistinctSpecializationIds(k_hit_points_comp));
  CHECK(test::hasDistinctSpecializationIds(k_predict_faces_comp));
}
