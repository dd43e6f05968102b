#include "trace/seed_order.h"

#include <tbb/parallel_sort.h>

#include <numeric>

namespace asdfvk {

SeedOrder::SeedOrder(const TraceScene& scene)
    : representatives_(scene.representatives), primitiveOfFace_(scene.representatives.size(), kNoFace) {
  for (uint32_t primitive = 0; primitive < scene.bvh.primitiveFaces.size(); ++primitive)
    primitiveOfFace_[scene.bvh.primitiveFaces[primitive]] = primitive;
}

std::vector<uint32_t> SeedOrder::of(std::span<const uint32_t> seedFaces) const {
  std::vector<uint32_t> order(seedFaces.size());
  std::iota(order.begin(), order.end(), 0u);
  tbb::parallel_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const uint32_t primitiveA = primitiveOf(seedFaces[a]), primitiveB = primitiveOf(seedFaces[b]);
    return primitiveA != primitiveB ? primitiveA < primitiveB : a < b;
  });
  return order;
}

}  // namespace asdfvk
