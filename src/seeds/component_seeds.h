#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// Further seeds for connected components in which no seed has a value. Each call of next() returns a batch of faces
/// from every such component, one face at first and twice as many each time, until one of its faces has a value; all
/// faces of a batch become seeds. A component of n faces of which none gets a value takes about log2(n) batches.
///
///     ComponentSeeds further(componentOf, values, untriedFaces, randomSeed);
///     for (auto batch = further.next(values); !batch.empty(); batch = further.next(values)) traceInto(values, batch);
class ComponentSeeds {
 public:
  /// componentOf, values: #F; NaN = no value. untriedFaces: the faces that can cast rays and are not seeds, each once.
  /// They are tried in random order, the same for the same input and randomSeed.
  ComponentSeeds(std::span<const uint32_t> componentOf, std::span<const double> values,
                 std::span<const uint32_t> untriedFaces, uint64_t randomSeed);

  /// The next batch, ascending, no face twice over all calls; empty when each component has a value or has no faces
  /// left. values: #F, with those of the last batch.
  [[nodiscard]] std::vector<uint32_t> next(std::span<const double> values);

 private:
  /// The faces of one component: order_[batchBegin .. tried) is the last batch, order_[tried .. end) is untried.
  struct Queue {
    size_t batchBegin = 0, tried = 0, end = 0;
  };

  std::vector<uint32_t> order_;
  std::vector<Queue> queues_;  ///< Of the components without a value that have faces to try, by component.
  size_t batchSize_ = 1;
};

}  // namespace asdfvk
