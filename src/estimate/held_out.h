#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk {

/// Random sample of faces. At these faces, the error of an interpolation that does not use them is measured without
/// bias.
struct HeldOutFaces {
  std::vector<uint32_t> faces;
  /// Sampling weight of each face: (c / p - 1) / (number of candidates per held-out face). p: inclusion probability of
  /// the face. c: its entry in representedCounts. c / p - 1 is the number of interpolated faces for which the face
  /// stands.
  std::vector<double> weights;
};

/// Random seed of held-out faces, independent of the seeds of samplers and of earlier rounds.
[[nodiscard]] constexpr uint64_t heldOutSeed(uint64_t randomSeed, uint64_t earlierHeldOutCount) {
  return (randomSeed ^ 0x7072'6f62'6500'0000u) + earlierHeldOutCount;
}

/// Samples `count` of the candidates, or all candidates if there are fewer. The inclusion probability of a face is at
/// most 1. It is proportional to c i^(9/8): i is the error indicator of the face, and c is the number of faces that it
/// represents. The exponent is above 1 because the held-out faces become seeds and so lower the error of the result
/// (bench/experiments.md). The method is the ordered pivotal method (Deville and Tille 1998, "Unequal probability
/// sampling without replacement through a splitting method"; Chauvet 2012). Neighbours in the list exclude each other,
/// so that the sample is spread over the list. indicator: #N, above 0. representedCounts: #N, the number of faces that
/// each face represents (itself and faces that get its value); if empty, each face represents only itself. If the
/// candidates are ascending, the sampled faces are ascending, too.
[[nodiscard]] HeldOutFaces sampleHeldOut(std::span<const uint32_t> candidates, std::span<const double> indicator,
                                         uint64_t count, uint64_t randomSeed,
                                         std::span<const uint32_t> representedCounts = {});

}  // namespace asdfvk
