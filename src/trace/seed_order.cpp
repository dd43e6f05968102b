#include "trace/seed_order.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "core/radix_sort.h"
#include "core/unset_vector.h"

namespace asdfvk {
namespace {

constexpr uint32_t kBitsPerAxis = 21;

/// Moves bit i to bit 3 i. bits: below 2^kBitsPerAxis.
uint64_t spread(uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f'0000'0000'ffffu;
  bits = (bits | bits << 16) & 0x001f'0000'ff00'00ffu;
  bits = (bits | bits << 8) & 0x100f'00f0'0f00'f00fu;
  bits = (bits | bits << 4) & 0x10c3'0c30'c30c'30c3u;
  return (bits | bits << 2) & 0x1249'2492'4924'9249u;
}

uint64_t mortonCode(const Vec3d& origin) {
  const auto bitsOf = [](double x) {
    constexpr double kCellCount = 1u << kBitsPerAxis;
    return spread(static_cast<uint64_t>(std::clamp((0.5 * x + 0.5) * kCellCount, 0.0, kCellCount - 1)));
  };
  return bitsOf(origin.x) << 2 | bitsOf(origin.y) << 1 | bitsOf(origin.z);
}

}  // namespace

SeedOrder::SeedOrder(const TraceScene& scene)
    : representatives_(scene.representatives), primitiveOfFace_(scene.representatives.size(), kNoFace) {
  forEachInParallel(scene.bvh.primitiveFaces.size(),
                    [&](uint32_t primitive) { primitiveOfFace_[scene.bvh.primitiveFaces[primitive]] = primitive; });
}

std::vector<uint32_t> SeedOrder::of(std::span<const uint32_t> seedFaces) const {
  struct Seed {
    uint32_t primitive, index;
  };
  const auto primitiveCount = static_cast<uint32_t>(primitiveOfFace_.size());
  UnsetVector<Seed> seeds(seedFaces.size());
  forEachInParallel(seeds.size(), [&](uint32_t i) {
    seeds[i] = {std::min(primitiveOf(seedFaces[i]), primitiveCount), i};
  });
  sortByKey(seeds, primitiveCount, [](const Seed& seed) { return seed.primitive; });
  std::vector<uint32_t> order(seeds.size());
  forEachInParallel(seeds.size(), [&](uint32_t i) { order[i] = seeds[i].index; });
  return order;
}

std::vector<uint32_t> spatialOrder(std::span<const ConeStart> starts) {
  std::vector<std::pair<uint64_t, uint32_t>> keys(starts.size());
  forEachInParallel(starts.size(), [&](uint32_t i) { keys[i] = {mortonCode(starts[i].origin), i}; });
  sortInParallel(keys.begin(), keys.end());
  std::vector<uint32_t> order(starts.size());
  forEachInParallel(starts.size(), [&](uint32_t i) { order[i] = keys[i].second; });
  return order;
}

}  // namespace asdfvk
