#pragma once

#include <cstdint>
#include <span>

namespace asdfvk {

/// Share of the pairs of items on which two labellings agree. The weight of a pair is the product of the weights of its
/// items. Two labellings agree on a pair if both give the two items the same label, or if both give them different
/// labels (W. Rand: Objective Criteria for the Evaluation of Clustering Methods, 1971). Pairs of an item with itself
/// count; for many items of small weight the result tends to the usual Rand index. The result is 0 to 1. The index is 1
/// if both labellings divide the items in the same way, or if no item has a weight. a, b, weights: one entry per item;
/// weights not negative. Labels should be small numbers, because the memory is proportional to the product of their
/// counts.
[[nodiscard]] double randIndex(std::span<const uint32_t> a, std::span<const uint32_t> b,
                               std::span<const float> weights);

/// Compares pairs of different items, all of equal weight.
[[nodiscard]] double randIndex(std::span<const uint32_t> a, std::span<const uint32_t> b);

}  // namespace asdfvk
