#include "trace/seed_order.h"

#include <tbb/parallel_sort.h>

#include <numeric>

namespace asdfvk {

SeedOrder::SeedOrder(const TraceScene& scene)
    : representatives_(scene.representatives), slotOfFace_(scene.representatives.size(), kNoFace) {
  for (uint32_t slot = 0; slot < scene.bvh.slotFaces.size(); ++slot) slotOfFace_[scene.bvh.slotFaces[slot]] = slot;
}

std::vector<uint32_t> SeedOrder::of(std::span<const uint32_t> seedFaces) const {
  std::vector<uint32_t> order(seedFaces.size());
  std::iota(order.begin(), order.end(), 0u);
  tbb::parallel_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const uint32_t slotA = slotOf(seedFaces[a]), slotB = slotOf(seedFaces[b]);
    return slotA != slotB ? slotA < slotB : a < b;
  });
  return order;
}

}  // namespace asdfvk
