#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// A random permutation of any set of faces, each listed once.
[[nodiscard]] std::vector<uint32_t> randomPermutationSeeds(std::span<const uint32_t> candidates, uint64_t count,
                                                           uint64_t randomSeed);

}  // namespace asdfvk
