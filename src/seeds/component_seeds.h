#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// Further seeds for connected components none of whose seeds has a value: "one seed after another until one has".
/// Each round asks for a batch of every such component, of one face first and of twice as many each time, so that a
/// component of n faces without any value takes about log2(n) rounds; all faces of a batch that get a value are seeds.
///
///     ComponentSeeds further(componentOf, values, untriedFaces, randomSeed);
///     for (auto batch = further.next(values); !batch.empty(); batch = further.next(values)) trace batch into values
class ComponentSeeds {
 public:
  /// componentOf, values: #F; values are NaN where a face has none. untriedFaces: the faces that can cast rays and have
  /// not, each once. The order in which they are tried is random, the same for the same input and randomSeed.
  ComponentSeeds(std::span<const uint32_t> componentOf, std::span<const double> values,
                 std::span<const uint32_t> untriedFaces, uint64_t randomSeed);

  /// The faces to try now, ascending, none twice over all calls; empty when every component has a value or no face
  /// left. values: as before, with what the last batch gave.
  [[nodiscard]] std::vector<uint32_t> next(std::span<const double> values);

 private:
  /// Faces of one component: order_[tried .. end) wait, order_[batchBegin .. tried) was asked for last.
  struct Queue {
    size_t batchBegin = 0, tried = 0, end = 0;
  };

  std::vector<uint32_t> order_;
  std::vector<Queue> queues_;  ///< Components that still lack a value and have faces to try, by component.
  size_t batchSize_ = 1;
};

}  // namespace asdfvk
