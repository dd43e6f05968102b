#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// The seed faces of the ASDF paper, section 4.2: of a seeded random permutation of the candidates every n-th is taken.
/// The paper's n is whole; here the i-th seed stands at floor(i * size / count) of the permutation, so that any count
/// comes out exactly.
/// candidates: the faces that can cast rays, each once. A count above their number takes all of them.
/// Returns the seed faces in ascending order of their index; the same for the same candidates, count and randomSeed.
[[nodiscard]] std::vector<uint32_t> randomPermutationSeeds(std::span<const uint32_t> candidates, uint64_t count,
                                                           uint64_t randomSeed);

}  // namespace asdfvk
