#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// Further seeds for connected components in which no seed has a value. Each call of next() returns a batch with faces
/// of every such component. All faces of the batch become seeds. The number of faces per component is 1 in the first
/// batch and doubles with each batch, until a face of the component has a value. A component of n faces without any
/// value takes about log2(n) batches.
///
///     ComponentSeeds further(componentOf, values, untriedFaces, randomSeed);
///     for (auto batch = further.next(values); !batch.empty(); batch = further.next(values)) traceInto(values, batch);
class ComponentSeeds {
 public:
  /// componentOf, values: #F; NaN = no value. untriedFaces: the faces that can cast rays and are not seeds, each once.
  /// Their order is random, and the same for the same input and randomSeed.
  ComponentSeeds(std::span<const uint32_t> componentOf, std::span<const double> values,
                 std::span<const uint32_t> untriedFaces, uint64_t randomSeed);

  /// Returns the next batch, ascending. A face occurs in one batch only. The batch is empty if every component has a
  /// value or no untried face. values: #F, including the values of the last batch.
  [[nodiscard]] std::vector<uint32_t> next(std::span<const double> values);

 private:
  /// The faces of one component: order_[batchBegin .. tried) is the last batch, order_[tried .. end) is untried.
  struct Queue {
    size_t batchBegin = 0, tried = 0, end = 0;
  };

  std::vector<uint32_t> order_;
  /// One queue per component that has no value and has untried faces, in the order of the components.
  std::vector<Queue> queues_;
  size_t batchSize_ = 1;
};

}  // namespace asdfvk
