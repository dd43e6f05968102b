#include "seeds/component_seeds.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/random.h"

namespace asdfvk {

ComponentSeeds::ComponentSeeds(std::span<const uint32_t> componentOf, std::span<const double> values,
                               std::span<const uint32_t> untriedFaces, uint64_t randomSeed) {
  ASDFVK_CHECK_OP(values.size(), ==, componentOf.size());
  uint32_t componentCount = 0;
  for (uint32_t component : componentOf) componentCount = std::max(componentCount, component + 1);
  std::vector<uint8_t> hasValue(componentCount, 0);
  for (size_t face = 0; face < values.size(); ++face)
    if (!std::isnan(values[face])) hasValue[componentOf[face]] = 1;

  for (uint32_t face : untriedFaces)
    if (!hasValue[componentOf[face]]) order_.push_back(face);
  Random random(randomSeed);
  random.shuffle(std::span<uint32_t>(order_));
  std::stable_sort(order_.begin(), order_.end(),
                   [&](uint32_t a, uint32_t b) { return componentOf[a] < componentOf[b]; });
  for (size_t begin = 0; begin < order_.size();) {
    size_t end = begin;
    while (end < order_.size() && componentOf[order_[end]] == componentOf[order_[begin]]) ++end;
    queues_.push_back({begin, begin, end});
    begin = end;
  }
}

std::vector<uint32_t> ComponentSeeds::next(std::span<const double> values) {
  std::erase_if(queues_, [&](const Queue& queue) {
    if (queue.tried == queue.end) return true;
    return std::any_of(order_.begin() + static_cast<std::ptrdiff_t>(queue.batchBegin),
                       order_.begin() + static_cast<std::ptrdiff_t>(queue.tried),
                       [&](uint32_t face) { return !std::isnan(values[face]); });
  });
  std::vector<uint32_t> batch;
  for (Queue& queue : queues_) {
    queue.batchBegin = queue.tried;
    queue.tried += std::min(batchSize_, queue.end - queue.tried);
    for (size_t i = queue.batchBegin; i < queue.tried; ++i) batch.push_back(order_[i]);
  }
  batchSize_ *= 2;
  std::sort(batch.begin(), batch.end());
  return batch;
}

}  // namespace asdfvk
