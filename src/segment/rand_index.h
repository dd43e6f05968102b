#pragma once

#include <cstdint>
#include <span>

namespace asdfvk {

/// Share of the pairs of items, weighted by the product of their weights, that two labellings treat alike: both put the
/// two items under one label, or both under two (W. Rand: Objective Criteria for the Evaluation of Clustering Methods,
/// 1971). Pairs of an item with itself count; for many items of small weight the result tends to the usual Rand index.
/// The result is 0 to 1. It is 1 if both labellings divide the items equally, and if no item has a weight. a, b,
/// weights: one entry per item; weights not negative. Labels should be small numbers: memory is the product of their
/// counts.
[[nodiscard]] double randIndex(std::span<const uint32_t> a, std::span<const uint32_t> b,
                               std::span<const float> weights);

/// Rand index over pairs of different items, all of equal weight.
[[nodiscard]] double randIndex(std::span<const uint32_t> a, std::span<const uint32_t> b);

}  // namespace asdfvk
